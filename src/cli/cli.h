// The command line as a function, so that tests can call it.
#pragma once

namespace rainref::cli {

/// Parses the arguments and runs the command. Returns the exit code; prints errors as one line on standard error.
int main(int argc, const char* const* argv);

}  // namespace rainref::cli
