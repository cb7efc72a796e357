# Makes the inline functions of a static library its own:
#   cmake -D AR=.. -D LINKER=.. -D NM=.. -D OBJCOPY=.. -P isolate.cmake LIBRARY
#
# The linker keeps one copy of each inline function and template instance, usually the program's. If
# the program is compiled with other flags, such as -march=native, that copy computes other bits.
# Therefore the objects are linked into one, in which these functions are local symbols.
cmake_minimum_required(VERSION 3.25)
math(EXPR last "${CMAKE_ARGC} - 1")
set(library "${CMAKE_ARGV${last}}")
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE out)
  set(out "${out}" PARENT_SCOPE)
endfunction()

set(object ${library}.o)
run(${LINKER} -r --whole-archive --force-group-allocation -o ${object} ${library})
run(${NM} --defined-only --format=posix ${object})
string(REGEX MATCHALL "[^\n]+ [WwVvu] [^\n]+" weak "${out}")
list(TRANSFORM weak REPLACE " .*" "")
list(JOIN weak "\n" weak)
file(WRITE ${library}.weak "${weak}\n")
run(${OBJCOPY} --localize-symbols=${library}.weak ${object})
file(REMOVE ${library})
run(${AR} qcs ${library} ${object})
file(REMOVE ${object} ${library}.weak)
