# Writes OUTPUT, which is INPUT with what the regular expression TAKEN matches replaced by LEFT.
cmake_minimum_required(VERSION 3.25)
file(READ "${INPUT}" text)
string(REGEX REPLACE "${TAKEN}" "${LEFT}" mutant "${text}")
if(mutant STREQUAL text)
  message(FATAL_ERROR "there is no ${TAKEN} to take out of ${INPUT}")
endif()
file(WRITE "${OUTPUT}" "${mutant}")
