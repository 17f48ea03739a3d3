#include <skein/arrays/types.hpp>  // forbidden: what everybody includes knows no device
