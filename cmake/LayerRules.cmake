# The layers, in the order in which data flows, and what each may include: read by the build (cmake/Layers.cmake) and
# by the checks in CTest (cmake/CheckLayers.cmake, tests/house/check_host_sources.py). Includes go left only.
#
# skein_layer(<name> [HOST] [PROGRAM] [PUBLIC layers its headers may include] [PRIVATE layers only its sources may include]
#             [EXTERNAL first path components of third-party headers its sources may include])
# HOST: no file of the layer reaches a header of Kokkos; it is compiled by the host's compiler also in builds for GPUs.
# PROGRAM: a part of the program, which is not installed as a library.
# A third-party header that no layer lists is open to all (fmt, Kokkos, the standard library).

skein_layer(core     HOST)
skein_layer(scene    HOST PUBLIC core                                                   EXTERNAL toml++)
skein_layer(fibers   HOST PUBLIC core scene)
skein_layer(arrays   PUBLIC core)
skein_layer(ranks    HOST PUBLIC core)
skein_layer(kernels  PUBLIC core arrays)
skein_layer(fmm      PUBLIC core arrays ranks                       PRIVATE kernels     EXTERNAL Eigen)
skein_layer(physics  PUBLIC core arrays ranks scene fibers fmm      PRIVATE kernels     EXTERNAL Eigen)
skein_layer(solvers  PUBLIC core arrays                                                 EXTERNAL Eigen)
skein_layer(dynamics PUBLIC core arrays scene fibers physics solvers PRIVATE kernels    EXTERNAL Eigen)
skein_layer(io       HOST PUBLIC core scene fibers                                      EXTERNAL hdf5.h xxhash.h)
skein_layer(analysis HOST PUBLIC core fibers                                            EXTERNAL Eigen)
skein_layer(runs     PROGRAM PUBLIC core arrays ranks scene fibers physics solvers dynamics io analysis)
skein_layer(mpi      HOST PROGRAM PUBLIC core ranks                                     EXTERNAL mpi.h)
skein_layer(studies  HOST PROGRAM PUBLIC core arrays scene fibers physics io analysis runs)
skein_layer(cli      HOST PROGRAM PUBLIC core arrays scene physics io runs mpi studies EXTERNAL CLI)
skein_layer(python   PROGRAM PUBLIC core arrays scene physics io runs studies              EXTERNAL pybind11)
