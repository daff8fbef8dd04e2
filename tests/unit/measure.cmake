blush_test(test_measure
  SOURCES
    measure_bias.cpp
    measure_bounce_energy.cpp
    measure_convergence.cpp
    measure_convergence_csv.cpp
    measure_convergence_runs.cpp
    measure_flip.cpp
    measure_metrics.cpp
    measure_picture_error.cpp
    measure_plot.cpp
    measure_scopes.cpp
  LIBS blush_measure fmt::fmt
  LABELS unit)
