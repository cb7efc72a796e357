# Counts the instructions of PROGRAM on SCENE with EFFECT off and without EFFECT in the scene: they may
# differ by a thousandth.
cmake_minimum_required(VERSION 3.25)

function(count_instructions how result)
  execute_process(
    COMMAND ${VALGRIND} --tool=callgrind --callgrind-out-file=/dev/null
            ${PROGRAM} ${SCENE} ${EFFECT} ${how}
    OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE code)
  if(NOT code EQUAL 0 OR NOT said MATCHES "Collected : ([0-9]+)")
    message(FATAL_ERROR "callgrind on ${PROGRAM} ${SCENE} ${EFFECT} ${how} ended with ${code}: ${said}")
  endif()
  set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()

count_instructions(off off)
count_instructions(absent absent)
math(EXPR difference "${off} - ${absent}")
string(REPLACE "-" "" difference "${difference}")
math(EXPR allowed "${absent} / 1000")
message(STATUS "${off} instructions with ${EFFECT} off, ${absent} without it")
if(difference GREATER allowed)
  message(SEND_ERROR "${EFFECT} executes instructions although it is off")
endif()
