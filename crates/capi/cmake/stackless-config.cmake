# Targets: stackless::stackless, the shared library, and stackless::static.
get_filename_component(_stackless "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET stackless::stackless)
  foreach(_kind so a)
    # Debian has a folder for each architecture.
    find_library(STACKLESS_${_kind} libstackless.${_kind} PATHS "${_stackless}"
      PATH_SUFFIXES lib lib64 lib/${CMAKE_LIBRARY_ARCHITECTURE} NO_DEFAULT_PATH REQUIRED)
    mark_as_advanced(STACKLESS_${_kind})
  endforeach()
  add_library(stackless::stackless SHARED IMPORTED)
  set_target_properties(stackless::stackless PROPERTIES
    IMPORTED_LOCATION "${STACKLESS_so}"
    INTERFACE_INCLUDE_DIRECTORIES "${_stackless}/include")
  add_library(stackless::static STATIC IMPORTED)
  set_target_properties(stackless::static PROPERTIES
    IMPORTED_LOCATION "${STACKLESS_a}"
    INTERFACE_LINK_LIBRARIES "pthread;dl;m"
    INTERFACE_INCLUDE_DIRECTORIES "${_stackless}/include")
endif()
