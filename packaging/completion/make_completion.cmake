# SPDX-License-Identifier: BSD-3-Clause
# Writes a completion for bash from the --help of an app: its options, the words of those
# that name them (a|b|c), files and folders. Called by cmake -P with APP, NAME, OUTPUT.
cmake_minimum_required(VERSION 3.16)
execute_process(COMMAND "${APP}" --help OUTPUT_VARIABLE help RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${APP} --help failed: ${status}")
endif()

string(REGEX MATCHALL "\n  (-h \\[ )?--[a-z0-9-]+( \\])?( [^ \n]+)?" options "${help}")
set(names)
set(files)
set(folders)
set(others)
set(cases)
foreach(option IN LISTS options)
  string(REGEX MATCH "--([a-z0-9-]+)( \\])?( ([^ ]+))?" ignored "${option}")
  set(name "--${CMAKE_MATCH_1}")
  set(argument "${CMAKE_MATCH_4}")
  list(APPEND names "${name}")
  if(argument MATCHES "\\|")
    string(REPLACE "|" " " words "${argument}")
    string(APPEND cases
      "    ${name}) COMPREPLY=($(compgen -W \"${words}\" -- \"$current\")); return ;;\n")
  elseif(argument MATCHES "^(FILE|arg$|CAMERA$)")
    list(APPEND files "${name}")
  elseif(argument MATCHES "^(FOLDER|DIR)")
    list(APPEND folders "${name}")
  elseif(argument)
    list(APPEND others "${name}")
  endif()
endforeach()
if(NOT "--help" IN_LIST names)
  message(FATAL_ERROR "no options found in ${APP} --help")
endif()

function(add_case names action)
  if(names)
    list(JOIN names "|" pattern)
    set(cases "${cases}    ${pattern}) ${action} ;;\n" PARENT_SCOPE)
  endif()
endfunction()
add_case("${files}" "compopt -o default; return")
add_case("${folders}"
  "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$current\"); return")
add_case("${others}" "return")
list(JOIN names " " words)

file(WRITE "${OUTPUT}"
"# bash completion of ${NAME}, made of its --help
_${NAME}() {
  local current=\${COMP_WORDS[COMP_CWORD]} previous=\${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  case $previous in
${cases}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W \"${words}\" -- \"$current\"))
  else
    compopt -o default
  fi
}
complete -F _${NAME} ${NAME}
")
