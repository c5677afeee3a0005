# Links of the installed pages that would lead nowhere become text: to manual pages, which are installed elsewhere
# (NAME with `man NAME`), and to files of the sources. Run at installation, with `documents`: the pages' folder.
set(link "\\[([^]]*)\\]\\(")
file(GLOB_RECURSE pages ${documents}/*.md)
foreach(page IN LISTS pages)
  file(RELATIVE_PATH name ${documents} ${page})
  string(REGEX REPLACE "[^/]+$" "" up "${name}")
  string(REGEX REPLACE "[^/]+/" "../" up "${up}")
  file(READ ${page} text)
  string(REPLACE "](${up}../examples/python/move_muscle.py)" "](${up}examples/move_muscle.py)" text "${text}")
  string(REGEX REPLACE "${link}${up}man/([a-z-]+)\\.[18]\\)" "\\1 (`man \\2`)" text "${text}")
  string(REGEX REPLACE "${link}${up}\\.\\./[^)]*\\)" "\\1" text "${text}")
  file(WRITE ${page} "${text}")
endforeach()
