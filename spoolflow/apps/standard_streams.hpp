#pragma once

namespace spoolflow::apps {

/// Takes the descriptors 0 to 2 where the program was started without them (`>&-`): else the next file that it opens
/// would be its standard output. Reading a closed input and writing a closed output still fail; what is said to a
/// closed standard error goes nowhere. First thing in main.
void hold_standard_streams();

}  // namespace spoolflow::apps
