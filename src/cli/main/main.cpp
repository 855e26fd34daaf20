#include "cli/cli.h"

int main(int argc, char** argv) { return rainref::cli::main(argc, argv); }
