# SPDX-License-Identifier: MIT
# The program from the outside: command lines, exit codes, reports, and the files it delivers,
# judged by code that shares nothing with it.
foreach(label fast long)
  if(label STREQUAL fast)
    set(name test_cli)
    set(folder cli)
    set(limit 400)
  else()
    set(name test_cli_long)
    set(folder cli/long)
    set(limit 3000)
  endif()
  elbowroom_tests(${name} ${folder} LABEL ${label} TIMEOUT ${limit} TOGETHER
    LINK elbowroom_judge elbowroom_io elbowroom_anatomy nlohmann_json::nlohmann_json)
  if(TARGET ${name})
    target_compile_definitions(${name} PRIVATE
      ELBOWROOM_PROGRAM="$<TARGET_FILE:elbowroom>" ELBOWROOM_DEMO_DIR="${CMAKE_BINARY_DIR}/assets")
    add_dependencies(${name} elbowroom elbowroom_demo_files)
  endif()
endforeach()
# The table of rigs serves here too.
if(TARGET test_cli_long)
  target_sources(test_cli_long PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/property/rigs/rig_table.cpp)
endif()
