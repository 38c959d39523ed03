# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later

# Targets that are built alone build what they load at run time, too.
#   cmake -DNINJA=ninja -DBUILD=folder [-DWITH_PYTHON=ON] -P check_targets.cmake
function(require_inputs target)
  execute_process(
    COMMAND ${NINJA} -C ${BUILD} -t inputs ${target}
    OUTPUT_VARIABLE inputs
    COMMAND_ERROR_IS_FATAL ANY)
  foreach(name IN LISTS ARGN)
    if(NOT inputs MATCHES "/${name}[^\n]*\n")
      message(SEND_ERROR "the target ${target} does not build ${name}")
    endif()
  endforeach()
endfunction()

require_inputs(palpate libpalpate_picture.so libpalpate_touch.so)
if(WITH_PYTHON)
  require_inputs(palpate_python_package PalpateElastostatics.so PalpateHaptics.so PalpateIO.so)
endif()
