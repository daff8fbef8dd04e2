blush_test(test_shading
  SOURCES shading_energy.cpp shading_focus.cpp shading_lanes.cpp shading_lights.cpp shading_model.cpp shading_sampling.cpp
  LIBS blush_shading LABELS shading)
