# The language, warnings, native code and sanitizers, for our own targets only: linked as $<BUILD_INTERFACE:...>, they are
# no part of the installed package.

add_library(skein_compiler_options INTERFACE)
target_compile_features(skein_compiler_options INTERFACE cxx_std_20)
# Only the host uses Eigen; its device annotations make nvcc warn.
target_compile_definitions(skein_compiler_options INTERFACE EIGEN_NO_CUDA EIGEN_NO_HIP EIGEN_DONT_PARALLELIZE)
target_compile_options(skein_compiler_options INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wno-psabi>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # All cry wolf over std::string in g++ 12; newer compilers and clang keep them.
  target_compile_options(skein_compiler_options INTERFACE -Wno-restrict -Wno-maybe-uninitialized -Wno-stringop-overflow
                                                          -Wno-array-bounds)
endif()
if(SKEIN_NATIVE)
  target_compile_options(skein_compiler_options INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang>:-march=native>)
endif()
if("CUDA" IN_LIST Kokkos_DEVICES)
  # fmt 9 takes nvcc for a compiler without constexpr; the pair formulas are constexpr so that device code may call them.
  target_compile_definitions(skein_compiler_options INTERFACE FMT_USE_CONSTEXPR=1)
  target_compile_options(skein_compiler_options INTERFACE --expt-relaxed-constexpr)
endif()
if(SKEIN_SANITIZE)
  target_compile_options(skein_compiler_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                                                          -fno-omit-frame-pointer)
  target_link_options(skein_compiler_options INTERFACE -fsanitize=address,undefined)
endif()
if(SKEIN_FUZZ)
  target_compile_options(skein_compiler_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# What the pair loops need to vectorize and to fuse multiplications with additions. Never -ffast-math: split single
# precision differences depend on the order in which they are written, and NaN must stay NaN.
add_library(skein_loop_options INTERFACE)
target_compile_options(skein_loop_options INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang>:-O3;-fno-math-errno;-fno-trapping-math;-ffp-contract=fast>)
