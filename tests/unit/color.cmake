blush_test(test_color
  SOURCES color_views.cpp color_config.cpp
  LIBS blush_color
  LABELS unit)
