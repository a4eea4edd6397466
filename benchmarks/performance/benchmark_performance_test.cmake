# A small generated scene as a set of one frame, the smallest of the benchmarks on rooms, and
# a copy of the pages: every block must be filled from the CSVs of this run, and those of real
# clouds must stay when there are no such CSVs.
#   cmake -D SCENE_APP=... -D PERFORMANCE=... -D STAGES=... -D PEERS=... -D SOURCE=...
#     -D FOLDER=... -P benchmark_performance_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${status}\n${output}")
  endif()
endfunction()

function(expect file)
  file(READ "${file}" text)
  foreach(part IN LISTS ARGN)
    string(FIND "${text}" "${part}" place)
    if(place EQUAL -1)
      message(FATAL_ERROR "'${part}' is not in ${file}")
    endif()
  endforeach()
endfunction()

function(report)
  run(/usr/bin/python3 "${SOURCE}/scripts/performance_report.py" "${FOLDER}/results"
    --page "${FOLDER}/performance.md" --readme "${FOLDER}/README.md"
    --pictures "${FOLDER}/pictures")
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/data/generated" "${FOLDER}/results")
run("${SCENE_APP}" "${FOLDER}/data/generated/room.pcd"
  --truth "${FOLDER}/data/generated/room.gt.png" --width 160 --height 120)
set(short --benchmark_min_time=0.001 --benchmark_out_format=csv)
run("${PERFORMANCE}" ${short} "--benchmark_out=${FOLDER}/results/rooms.csv"
  "--benchmark_filter=(pipeline|floor)/.*(160x120|320x240)|labels:[24]/|instructions/(load|sums)"
  --benchmark_repetitions=2 --benchmark_enable_random_interleaving=true)
run("${PERFORMANCE}" ${short} "--benchmark_out=${FOLDER}/results/memory.csv"
  "--benchmark_filter=memory/.*160x120")
file(WRITE "${FOLDER}/results/machine.csv" "processor,\"Z80, 4 MHz\"\ncompiler,SDCC\n")
file(COPY "${SOURCE}/doc/performance.md" "${SOURCE}/README.md" DESTINATION "${FOLDER}")

# Without clouds the blocks about these stay.
file(READ "${FOLDER}/README.md" readme)
report()
file(READ "${FOLDER}/README.md" untouched)
if(NOT untouched STREQUAL readme)
  message(FATAL_ERROR "README.md changed without real clouds")
endif()
expect("${FOLDER}/performance.md" "| processor | Z80, 4 MHz |" "At 160x120:"
  "| size | points | FAST | DEFAULT | PAPER | PAPER, 10 labels |\n| --- | --- | --- | --- | --- | --- |\n| 160x120 | 19200 | "
  "\n| 320x240 | 76800 | " "| labels | 1 iteration | 5 iterations | 20 iterations |\n"
  "| reading into planes |" "| FAST | 160x120 | 0.3 |"
  "| FAST, growth with points | exponent at most 1 |")

run("${STAGES}" --data "${FOLDER}/data" --width 160 --height 120 --repeat 2
  --output "${FOLDER}/results/stages.csv")
run("${STAGES}" --data "${FOLDER}/data" --width 160 --height 120 --repeat 2 --labels 1 2
  --output "${FOLDER}/results/labels.csv")
run("${PEERS}" --data "${FOLDER}/data" --repeat 1 --methods mrf_planes pcl_multi_plane
  --output "${FOLDER}/results/peers.csv")
report()
expect("${FOLDER}/performance.md" "One object for all 1 clouds"
  "1 clouds, a new object for each" "| stage | FAST | DEFAULT | PAPER |\n"
  "The longest stage of PAPER is " "On the same cloud 2 labels take ")
expect("${FOLDER}/README.md" "One core of Z80, 4 MHz, SDCC, 640x480"
  "over 1 frames" "| profile FAST | ")
foreach(name points labels stages)
  set(picture "${FOLDER}/pictures/performance_${name}.png")
  file(SIZE "${picture}" size)
  if(size GREATER 200000)
    message(FATAL_ERROR "${picture} is too large: ${size} bytes")
  endif()
endforeach()
