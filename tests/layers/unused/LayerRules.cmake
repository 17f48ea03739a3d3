# One allowance of each kind that is used, and one that is not.
skein_layer(core EXTERNAL zlib.h)
skein_layer(arrays)
skein_layer(scene PUBLIC core arrays PRIVATE fibers EXTERNAL toml++)
skein_layer(fibers PUBLIC core)
