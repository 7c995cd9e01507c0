# SPDX-License-Identifier: MIT
# The independent judge: shares no code with core/ (a test checks that), so that what it
# finds does not repeat an error of what it judges.
find_path(FCL_INCLUDE_DIR fcl/fcl.h REQUIRED)
find_library(FCL_LIBRARY fcl REQUIRED)
find_library(CCD_LIBRARY ccd REQUIRED)
find_package(CGAL REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

file(GLOB judge_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/judge*.cpp)
add_library(elbowroom_judge STATIC ${judge_sources})
target_link_libraries(elbowroom_judge
  PUBLIC elbowroom_flags glm::glm
  PRIVATE nlohmann_json::nlohmann_json CGAL::CGAL Eigen3::Eigen ${FCL_LIBRARY} ${CCD_LIBRARY})
# Exact predicates count on the rounding the language prescribes.
target_compile_options(elbowroom_judge PRIVATE -frounding-math)
target_include_directories(elbowroom_judge SYSTEM PRIVATE ${FCL_INCLUDE_DIR})

elbowroom_tests(test_judge judge/test LABEL fast LINK elbowroom_judge)
target_compile_definitions(test_judge PRIVATE ELBOWROOM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
