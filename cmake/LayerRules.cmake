# The layers, in the order in which data flows, and what each may include: read by the build (cmake/Layers.cmake) and
# by the check in CTest (cmake/CheckLayers.cmake). Includes go left only.
#
# skein_layer(<name> [PUBLIC layers its headers may include] [PRIVATE layers only its sources may include]
#             [EXTERNAL first path components of third-party headers its sources may include])
# A third-party header that no layer lists is open to all (fmt, Kokkos, the standard library).

skein_layer(core)
skein_layer(scene    PUBLIC core                                                        EXTERNAL toml++)
skein_layer(fibers   PUBLIC core scene)
skein_layer(arrays   PUBLIC core)
skein_layer(kernels  PUBLIC core arrays)
skein_layer(fmm      PUBLIC core arrays                             PRIVATE kernels     EXTERNAL Eigen)
skein_layer(physics  PUBLIC core arrays scene fibers fmm            PRIVATE kernels)
skein_layer(solvers  PUBLIC core arrays                                                 EXTERNAL Eigen)
skein_layer(dynamics PUBLIC core arrays scene fibers physics solvers PRIVATE kernels    EXTERNAL Eigen)
skein_layer(io       PUBLIC core scene fibers                                           EXTERNAL hdf5.h xxhash.h)
skein_layer(analysis PUBLIC core fibers                                                 EXTERNAL Eigen)
skein_layer(runs     PUBLIC core arrays scene fibers physics solvers dynamics io analysis)
skein_layer(studies  PUBLIC core arrays scene fibers physics io runs)
skein_layer(cli      PUBLIC core arrays scene fibers physics io runs studies            EXTERNAL CLI)
