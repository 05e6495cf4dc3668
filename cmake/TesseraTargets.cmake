# Flags every target of the project shares, and the three kinds of target it has.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# All executables in one folder: the program finds its helpers beside itself.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

add_library(tessera_flags INTERFACE)
target_compile_features(tessera_flags INTERFACE cxx_std_20)
# Contraction to fused multiply-add is off so that Debug and Release give the same bits. GCC 12 reports phantom array
# bounds where it unrolls Eigen's packet loops over 3-vectors (AddressSanitizer finds no such access): that one is off.
target_compile_options(tessera_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wno-array-bounds -ffp-contract=off
  $<$<CONFIG:Release>:-O3> $<$<BOOL:${TESSERA_ARCH}>:-march=${TESSERA_ARCH}>
  $<$<BOOL:${TESSERA_WERROR}>:-Werror>)
if(TESSERA_SANITIZE)
  target_compile_options(tessera_flags INTERFACE -fsanitize=${TESSERA_SANITIZE} -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=undefined)
  target_link_options(tessera_flags INTERFACE -fsanitize=${TESSERA_SANITIZE})
endif()
target_include_directories(tessera_flags INTERFACE ${PROJECT_SOURCE_DIR})

# tessera_library(NAME SOURCES ... PUBLIC ... PRIVATE ...): static library tessera_NAME with alias tessera::NAME.
function(tessera_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(tessera_${name} STATIC ${ARG_SOURCES})
  add_library(tessera::${name} ALIAS tessera_${name})
  target_link_libraries(tessera_${name} PUBLIC tessera_flags ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()

# tessera_program(NAME SOURCES ... LINK ...): executable in bin/.
function(tessera_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE tessera_flags ${ARG_LINK})
endfunction()

# Tests run side by side: each on one thread unless it asks for more itself, and no thread spins while it waits.
set(tessera_test_environment "OMP_NUM_THREADS=1;GOMP_SPINCOUNT=2000")

# tessera_test(NAME LABEL unit|verification|regression|cli SOURCES ... LINK ... [TIMEOUT seconds]): GoogleTest
# executable whose cases CTest lists one by one under that label.
function(tessera_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  tessera_program(${name} SOURCES ${ARG_SOURCES} LINK ${ARG_LINK} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE TESSERA_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             TESSERA_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  gtest_discover_tests(${name} TEST_PREFIX ${ARG_LABEL}. DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT}
                                  ENVIRONMENT "${tessera_test_environment}")
endfunction()
