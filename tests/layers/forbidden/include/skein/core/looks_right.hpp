#include <skein/core/simd.hpp>  // forbidden: public headers never include device code
