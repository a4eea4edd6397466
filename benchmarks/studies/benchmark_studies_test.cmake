# A generated scene with its ground truth as a set of one frame: both programs must write
# complete CSVs.
#   cmake -D SCENE_APP=... -D STUDIES=... -D INFERENCE=... -D FOLDER=... -P ...
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${status}\n${output}")
  endif()
endfunction()

# expect(FILE PATTERN...): each of the lines after the header is there.
function(expect file)
  if(EXISTS "${file}.part")
    message(FATAL_ERROR "the unfinished ${file} is still there")
  endif()
  file(READ "${file}" text)
  foreach(pattern IN LISTS ARGN)
    if(NOT text MATCHES "\n${pattern}")
      message(FATAL_ERROR "no line '${pattern}' in ${file}")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/data/generated")
run("${SCENE_APP}" "${FOLDER}/data/generated/room.pcd"
  --truth "${FOLDER}/data/generated/room.gt.png" --width 160 --height 120)
run("${STUDIES}" --data "${FOLDER}/data" --studies ablation sensitivity
  --output "${FOLDER}/studies.csv")
expect("${FOLDER}/studies.csv" "ablation,default,generated,room,160,120,[0-9.e+-]+,[1-9]"
  "ablation,no passes,generated,room," "sensitivity,default,generated,room,"
  "sensitivity,none-cost 6 instead of 3,generated,room,")
run("${INFERENCE}" --data "${FOLDER}/data" --iterations 3
  --output "${FOLDER}/inference.csv")
expect("${FOLDER}/inference.csv" "generated,room,[0-9.]+,50,[0-9]+,[0-9.]+"
  "rooms,room 1,[0-9.]+,0,")
