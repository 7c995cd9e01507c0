# SPDX-License-Identifier: MIT
# What collision queries rest on: Embree (3.13 on Debian 12, 4.3 on Debian 13; core/collision/
# ray_scene.cpp hides which), OpenMesh for topology, Highway for wide code with run-time dispatch.
# All three stay inside the .cpp files: no user of the library sees their headers.
find_package(hwy REQUIRED)

find_path(ELBOWROOM_EMBREE4_INCLUDE embree4/rtcore.h)
find_path(ELBOWROOM_EMBREE3_INCLUDE embree3/rtcore.h)
find_library(ELBOWROOM_EMBREE_LIBRARY NAMES embree4 embree3)
find_path(ELBOWROOM_OPENMESH_INCLUDE OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh)
find_library(ELBOWROOM_OPENMESH_LIBRARY NAMES OpenMeshCore)
if(NOT ELBOWROOM_EMBREE_LIBRARY OR NOT (ELBOWROOM_EMBREE4_INCLUDE OR ELBOWROOM_EMBREE3_INCLUDE))
  message(FATAL_ERROR "Embree 3 or 4 not found (Debian package libembree-dev)")
endif()
if(NOT ELBOWROOM_OPENMESH_LIBRARY OR NOT ELBOWROOM_OPENMESH_INCLUDE)
  message(FATAL_ERROR "OpenMesh not found (Debian package libopenmesh-dev)")
endif()

# Without sources the library is an interface one and has nothing to link privately.
get_target_property(collision_type elbowroom_collision TYPE)
if(NOT collision_type STREQUAL "INTERFACE_LIBRARY")
  if(ELBOWROOM_EMBREE_LIBRARY MATCHES "embree4")
    target_compile_definitions(elbowroom_collision PRIVATE ELBOWROOM_EMBREE_MAJOR=4)
    target_include_directories(elbowroom_collision SYSTEM PRIVATE ${ELBOWROOM_EMBREE4_INCLUDE})
  else()
    target_compile_definitions(elbowroom_collision PRIVATE ELBOWROOM_EMBREE_MAJOR=3)
    target_include_directories(elbowroom_collision SYSTEM PRIVATE ${ELBOWROOM_EMBREE3_INCLUDE})
  endif()
  target_include_directories(elbowroom_collision SYSTEM PRIVATE ${ELBOWROOM_OPENMESH_INCLUDE})
  target_link_libraries(elbowroom_collision PRIVATE ${ELBOWROOM_EMBREE_LIBRARY}
                        ${ELBOWROOM_OPENMESH_LIBRARY} hwy::hwy)
endif()
