// rainref with a sixth effect: its command line, and one entry more in the registry.
#include "breath/breath.h"

#include "cli/cli.h"
#include "registry/evaluations.h"
#include "registry/registry.h"

int main(int argc, char** argv) {
  rainref::registry::add(rainref::breath::entry());
  rainref::registry::add_evaluations("breath", rainref::breath::evaluations());
  return rainref::cli::main(argc, argv);
}
