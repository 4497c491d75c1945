# Copies the files NAMES from the folder ROOT to the folder COPIES, and applies the patch file PATCH
# to the copies.
string(REPLACE "," ";" names ${NAMES})
foreach(name IN LISTS names)
  get_filename_component(folder ${COPIES}/${name} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  file(REMOVE ${COPIES}/${name})
  file(COPY ${ROOT}/${name} DESTINATION ${folder})
endforeach()
# The copies do not belong to a git repository. Therefore git must not use the repository of a
# parent folder.
get_filename_component(above ${COPIES} DIRECTORY)
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env GIT_CEILING_DIRECTORIES=${above} git apply --whitespace=nowarn ${PATCH}
  WORKING_DIRECTORY ${COPIES} RESULT_VARIABLE failed)
if(failed)
  foreach(name IN LISTS names)
    file(REMOVE ${COPIES}/${name})
  endforeach()
  message(FATAL_ERROR "${PATCH} does not apply to the sources: create the patch again from the changed source files")
endif()
foreach(name IN LISTS names)
  file(TOUCH ${COPIES}/${name})
endforeach()
