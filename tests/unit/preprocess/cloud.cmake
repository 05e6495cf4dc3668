tessera_test(test_cloud LABEL unit
  SOURCES
    cloud/test_parts.cpp
    cloud/test_prepare.cpp
    seeding/test_seeding.cpp
    voronoi/test_convex_cell.cpp
    voronoi/test_restricted_voronoi.cpp
  LINK tessera::preprocess tessera::test_domains)
add_dependencies(test_cloud tessera-import)
