#include "kernels/simd.hpp"  // forbidden: public headers never include device code
