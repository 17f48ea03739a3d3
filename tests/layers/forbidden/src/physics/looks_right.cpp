#include <skein/arrays/types.hpp>
#include <skein/solvers/integrator.hpp>  // forbidden: forces do not know who asks for them

#include <hdf5.h>  // forbidden: only io writes files
