blush_test(test_core SOURCES core_distribution.cpp core_helping_threads.cpp core_math.cpp core_numbered_arrays.cpp core_sampler.cpp core_sampling.cpp core_statistics.cpp LIBS blush_core LABELS core)
