# Writes OUT from LICENCES, <name>=<file> separated by "|".
string(REPLACE "|" ";" LICENCES "${LICENCES}")
set(text "hooke is under the MIT licence, see LICENSE. The library, the program and share/ hold parts of other works besides, each under
a licence that allows that. For each, its own words or what Debian records of its source, of which some files are not in here:\n")
foreach(entry IN LISTS LICENCES)
  string(REGEX MATCH "^([^=]+)=(.*)$" _ "${entry}")
  set(name ${CMAKE_MATCH_1})
  file(READ ${CMAKE_MATCH_2} record)
  string(LENGTH ${name} length)
  string(REPEAT "=" ${length} line)
  string(APPEND text "\n\n${name}\n${line}\n\n${record}")
endforeach()
file(WRITE ${OUT} "${text}")
