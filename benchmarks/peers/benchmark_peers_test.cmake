# A generated scene with its ground truth as a set of one frame, and all the methods on it:
# the CSV must be there and every line of it complete.
#   cmake -D SCENE_APP=... -D PROGRAM=... -D FOLDER=... -P benchmark_peers_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${status}\n${output}")
  endif()
endfunction()

set(csv "${FOLDER}/accuracy.csv")
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/data/generated")
run("${SCENE_APP}" "${FOLDER}/data/generated/room.pcd"
  --truth "${FOLDER}/data/generated/room.gt.png" --width 320 --height 240)
run("${PROGRAM}" --data "${FOLDER}/data" --repeat 1 --output "${csv}"
  --labels "${FOLDER}/labels")

if(EXISTS "${csv}.part")
  message(FATAL_ERROR "the unfinished CSV is still there")
endif()
file(STRINGS "${csv}" lines)
list(POP_FRONT lines header)
string(REGEX MATCHALL "," header_commas "${header}")
list(LENGTH header_commas columns)
foreach(line IN LISTS lines)
  string(REGEX MATCHALL "," commas "${line}")
  list(LENGTH commas found)
  if(NOT found EQUAL columns)
    message(FATAL_ERROR "a line has not as many columns as the header: ${line}")
  endif()
  # The room has planes: a method without any, or without a score, is broken.
  if(NOT line MATCHES "^([a-z_]+),([a-z]+),generated,room,320,240,[0-9.e+]+,[1-9]")
    message(FATAL_ERROR "no time or no true planes: ${line}")
  endif()
  set(labels "${FOLDER}/labels/${CMAKE_MATCH_1}.${CMAKE_MATCH_2}/generated/room.png")
  if(NOT EXISTS "${labels}")
    message(FATAL_ERROR "there is no ${labels}")
  endif()
endforeach()
if(NOT "${lines}" MATCHES "mrf_planes,default" OR NOT "${lines}" MATCHES "pcl_ransac,tuned")
  message(FATAL_ERROR "methods are missing in ${csv}")
endif()
