#include <skein/arrays/types.hpp>
#include <skein/solvers/integrator.hpp>  // forbidden: data has not come there yet

#include <hdf5.h>  // forbidden: only io writes files
