# Whether runs can be shared by ranks: SKEIN_MPI becomes OFF where no MPI is found.
if(SKEIN_MPI)
  set(MPI_CXX_SKIP_MPICXX ON)  # the C++ bindings, which MPI has given up
  find_package(MPI QUIET COMPONENTS CXX)
  if(MPI_CXX_FOUND)
    message(STATUS "MPI ${MPI_CXX_VERSION} in ${MPI_CXX_LIBRARIES}: runs can be shared by ranks (mpirun -n 4 skein run ...)")
  else()
    set(SKEIN_MPI OFF)
    message(STATUS "MPI: none is found, so that runs have one process (tools/setup.sh --with-mpi)")
  endif()
else()
  message(STATUS "MPI: left out, runs have one process (SKEIN_MPI)")
endif()
