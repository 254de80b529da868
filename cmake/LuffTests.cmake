# luff_tests(SHELF FOLDER): see tests/CMakeLists.txt.
set(LUFF_TEST_ENVIRONMENT
    "OMP_NUM_THREADS=1;OMP_WAIT_POLICY=passive;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_mpi_yield_when_idle=1;OMPI_MCA_btl_base_warn_component_unused=0"
    CACHE INTERNAL "")

function(luff_test_program program library)
  add_executable(${program} ${ARGN})
  target_link_libraries(${program} PRIVATE luff_test_support luff::${library})
  target_compile_definitions(${program} PRIVATE LUFF_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LUFF_BINARY="$<TARGET_FILE:luff_app>")
endfunction()

function(luff_tests shelf folder)
  file(GLOB serial CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${shelf}/${folder}/*_test.cpp)
  set(ranks ${serial})
  list(FILTER ranks INCLUDE REGEX "_ranks_test.cpp$")
  list(FILTER serial EXCLUDE REGEX "_ranks_test.cpp$")
  if(serial)
    luff_test_program(${shelf}_${folder} ${folder} ${serial})
    add_test(NAME ${shelf}_${folder} COMMAND ${shelf}_${folder})
    set_tests_properties(${shelf}_${folder} PROPERTIES ENVIRONMENT "${LUFF_TEST_ENVIRONMENT}" LABELS ${shelf})
  endif()
  if(ranks)
    luff_test_program(${shelf}_${folder}_ranks ${folder} ${ranks})
    foreach(n 1 2 4)
      add_test(NAME ${shelf}_${folder}_ranks_${n} COMMAND ${MPIEXEC_EXECUTABLE} -n ${n} $<TARGET_FILE:${shelf}_${folder}_ranks>)
      set_tests_properties(${shelf}_${folder}_ranks_${n} PROPERTIES ENVIRONMENT "${LUFF_TEST_ENVIRONMENT}" LABELS ${shelf} PROCESSORS 2)
    endforeach()
  endif()
endfunction()
