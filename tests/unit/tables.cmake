blush_test(test_tables
  SOURCES
    shading_tables_environment.cpp
    shading_tables_lanes.cpp
    shading_tables_material.cpp
    shading_tables_mips.cpp
    shading_tables_texture.cpp
  LIBS blush_render
  LABELS unit)

# The same sources once per instruction set, for the comparison of their bits.
foreach(level v2 v3 v4)
  add_library(shading_tables_${level} OBJECT shading_tables_wide.cpp)
  target_link_libraries(shading_tables_${level} PRIVATE blush_render)
  target_include_directories(shading_tables_${level} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(shading_tables_${level} PRIVATE BLUSH_ISA=isa_${level})
  target_compile_options(shading_tables_${level} PRIVATE -march=x86-64-${level} -Wno-uninitialized -Wno-maybe-uninitialized)
  target_link_libraries(test_tables PRIVATE shading_tables_${level})
endforeach()
