blush_test(test_measure
  SOURCES
    measure_bounce_energy.cpp
    measure_flip.cpp
    measure_metrics.cpp
  LIBS blush_measure
  LABELS unit)
