# The layers, in the order in which data flows, and what each may include: read by the build (cmake/Layers.cmake) and
# by the check in CTest (cmake/CheckLayers.cmake). Includes go left only.
#
# skein_layer(<name> [PUBLIC layers its headers may include] [PRIVATE layers only its sources may include]
#             [EXTERNAL first path components of third-party headers its sources may include])
# A third-party header that no layer lists is open to all (fmt, Kokkos, the standard library).

skein_layer(core)
skein_layer(config   PUBLIC core                                   EXTERNAL toml++)
skein_layer(scene    PUBLIC core config                            EXTERNAL Eigen)
skein_layer(kernels  PUBLIC core                                   EXTERNAL Eigen)
skein_layer(model    PUBLIC core config scene     PRIVATE kernels)
skein_layer(hydro    PUBLIC core config           PRIVATE kernels  EXTERNAL Eigen mpi.h)
skein_layer(time     PUBLIC core config scene model hydro PRIVATE kernels EXTERNAL Eigen)
skein_layer(io       PUBLIC core config scene     PRIVATE kernels  EXTERNAL hdf5.h xxhash.h)
skein_layer(analysis PUBLIC core config scene model io PRIVATE kernels EXTERNAL Eigen)
skein_layer(app      PUBLIC core config scene model hydro time io analysis EXTERNAL CLI)
