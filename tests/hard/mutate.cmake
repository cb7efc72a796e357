# Writes INPUT to OUTPUT with matches of the regular expression TAKEN replaced by LEFT.
cmake_minimum_required(VERSION 3.25)
file(READ "${INPUT}" text)
string(REGEX REPLACE "${TAKEN}" "${LEFT}" mutant "${text}")
if(mutant STREQUAL text)
  message(FATAL_ERROR "${TAKEN} matches nothing in ${INPUT}")
endif()
file(WRITE "${OUTPUT}" "${mutant}")
