#pragma once

namespace skein {

/// What must hold before the program opens its first file. Descriptors 0 to 2 that are closed are opened on /dev/null:
/// else files of a run would get their numbers, and messages would be written into them. And a closed pipe or a limit
/// on file sizes make writes fail, with a message and an exit code, instead of ending the process.
void prepare_process();

}  // namespace skein
