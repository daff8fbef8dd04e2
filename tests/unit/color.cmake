blush_test(test_color
  SOURCES color_views.cpp color_config.cpp color_stage.cpp
  LIBS blush_color fmt::fmt
  LABELS unit)
