tessera_test(test_cloud LABEL unit
  SOURCES
    cloud/test_prepare.cpp
    voronoi/test_convex_cell.cpp
  LINK tessera::preprocess tessera::test_domains)
