# Finds the Voro++ library (Debian: voro++-dev), which comes without a CMake configuration of its own.
# Defines Voro++_FOUND and the target Voro++::Voro++. Set Voro++_ROOT where it is installed off the usual path.

find_path(Voro++_INCLUDE_DIR voro++/voro++.hh)
find_library(Voro++_LIBRARY voro++)
mark_as_advanced(Voro++_INCLUDE_DIR Voro++_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Voro++ REQUIRED_VARS Voro++_LIBRARY Voro++_INCLUDE_DIR)

if(Voro++_FOUND AND NOT TARGET Voro++::Voro++)
  add_library(Voro++::Voro++ UNKNOWN IMPORTED)
  set_target_properties(Voro++::Voro++ PROPERTIES
    IMPORTED_LOCATION ${Voro++_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Voro++_INCLUDE_DIR})
endif()
