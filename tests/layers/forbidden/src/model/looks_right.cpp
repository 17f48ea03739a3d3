#include <skein/core/types.hpp>
#include <skein/time/integrator.hpp>  // forbidden: data has not come there yet

#include <hdf5.h>  // forbidden: only io writes files
