# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Who may include whom. cmake -DSOURCE=<top of the tree> -P tests/check_layers.cmake

set(failures "")

# forbid(<what> <files...> PATTERN <regex> [EXCEPT <regex>]): no line of the files matches the pattern,
# but in files whose name matches EXCEPT.
function(forbid what)
  cmake_parse_arguments(ARG "" "PATTERN;EXCEPT" "FILES" ${ARGN})
  file(GLOB_RECURSE files RELATIVE ${SOURCE} ${ARG_FILES})
  if(NOT files)
    list(APPEND failures "no files to check: ${what}")
  endif()
  foreach(file IN LISTS files)
    if(ARG_EXCEPT AND file MATCHES "${ARG_EXCEPT}")
      continue()
    endif()
    file(STRINGS ${SOURCE}/${file} lines REGEX "${ARG_PATTERN}")
    foreach(line IN LISTS lines)
      list(APPEND failures "${file}: ${what}: ${line}")
    endforeach()
  endforeach()
  set(failures "${failures}" PARENT_SCOPE)
endfunction()

set(core ${SOURCE}/filters/core)
set(all_core ${core}/*.h ${core}/*.cpp)
set(include "^[ \t]*#[ \t]*include[ \t]*[<\"]")

forbid("core includes VTK" FILES ${all_core} PATTERN "${include}vtk")
forbid("core includes what lies above it" FILES ${all_core} PATTERN "${include}(apps|vtk|picture)/")
forbid("core prints" FILES ${all_core} PATTERN "std::(cout|cerr|clog)|[^a-z]f?printf[ ]*\\(")
# The rooms that make Green's functions.
set(producers bem fem halfspace identification imported shell)
foreach(room IN LISTS producers)
  set(others ${producers})
  list(REMOVE_ITEM others ${room})
  list(JOIN others "|" others)
  forbid("a producer of Green's functions includes a consumer or another producer"
    FILES ${core}/${room}/*.h ${core}/${room}/*.cpp PATTERN "${include}(${others}|contact|haptics)/")
endforeach()
list(JOIN producers "|" producers)
forbid("contact includes the haptic room" FILES ${core}/contact/*.h ${core}/contact/*.cpp
  PATTERN "${include}haptics/")
forbid("a consumer of Green's functions includes a producer"
  FILES ${core}/contact/*.h ${core}/contact/*.cpp ${core}/haptics/*.h ${core}/haptics/*.cpp
  PATTERN "${include}(${producers})/")
forbid("Green's functions include a producer or a consumer"
  FILES ${core}/greens/*.h ${core}/greens/*.cpp
  PATTERN "${include}(${producers}|contact|haptics)/")
forbid("the accuracy room includes another" FILES ${core}/accuracy/*.h ${core}/accuracy/*.cpp
  PATTERN "${include}(mesh|model|${producers}|greens|contact|haptics)/")
forbid("the mesh room includes a room above it" FILES ${core}/mesh/*.h ${core}/mesh/*.cpp
  PATTERN "${include}(model|${producers}|greens|contact|haptics)/")
forbid("a header includes a third party other than Eigen" FILES ${core}/*.h
  PATTERN "${include}(CGAL|OpenMesh|xsimd|ceres|hidapi|nlohmann|boost|lapacke|cblas)"
  EXCEPT "filters/core/(simd/|mesh/(cgal|open_mesh)_surface[.]h|haptics/json_reader[.]h)")
forbid("the header that reads JSON leaves its sources" FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}haptics/json_reader[.]h" EXCEPT "filters/core/haptics/.*[.]cpp$")
forbid("CGAL's own header leaves its sources" FILES ${all_core}
  PATTERN "${include}mesh/cgal_surface[.]h" EXCEPT "filters/core/mesh/.*[.]cpp$")
forbid("CGAL outside the mesh room" FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}CGAL" EXCEPT "filters/core/mesh/(.*[.]cpp|cgal_surface[.]h)$")
forbid("OpenMesh outside the mesh room" FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}OpenMesh" EXCEPT "filters/core/mesh/(.*[.]cpp|open_mesh_surface[.]h)$")
forbid("OpenMesh's own header leaves its sources" FILES ${all_core}
  PATTERN "${include}mesh/open_mesh_surface[.]h" EXCEPT "filters/core/mesh/.*[.]cpp$")
forbid("hidapi outside its one source" FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}hidapi" EXCEPT "filters/core/haptics/hidapi_bus[.]cpp$")
forbid("MUMPS outside its one source" FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}.?mumps" EXCEPT "filters/core/linear_algebra/sparse_factorization[.]cpp$")
forbid("Ceres outside its one source" FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}(ceres|glog)" EXCEPT "filters/core/identification/ceres_least_squares[.]cpp$")
forbid("JSON outside the header that reads it"
  FILES ${all_core} ${SOURCE}/filters/vtk/* ${SOURCE}/apps/*
  PATTERN "${include}nlohmann" EXCEPT "filters/core/haptics/json_reader[.]h$")
forbid("a filter includes an app" FILES ${SOURCE}/filters/vtk/*.h ${SOURCE}/filters/vtk/*.cxx
  PATTERN "${include}(apps|picture|terminal|commands)")
forbid("a public VTK header includes the core or Eigen" FILES ${SOURCE}/filters/vtk/*/vtk*.h
  PATTERN "${include}(Eigen|(mesh|model|${producers}|greens|contact|haptics)/)")
forbid("batch filters include rendering or devices"
  FILES ${SOURCE}/filters/vtk/elastostatics/* ${SOURCE}/filters/vtk/io/*
  PATTERN "${include}(vtkRender|vtkActor|vtkInteractor|hidapi)")
forbid("an app outside the drawing libraries renders" FILES ${SOURCE}/apps/*.cpp ${SOURCE}/apps/*.h
  PATTERN "${include}(vtkRender|vtkActor)" EXCEPT "apps/(picture|touch)/")

if(failures)
  string(REPLACE ";" "\n" text "${failures}")
  message(FATAL_ERROR "${text}")
endif()
