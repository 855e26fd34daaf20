// For a platform or a build without cpp-httplib.
#include "cli/view/server.h"
#include "rainref/error.h"

namespace rainref::cli {

class Server::Listening {};

void Server::require() { throw Error(ExitCode::usage, "view: this build of rainref shows no page: it was made without cpp-httplib"); }
Server::Server(int) { require(); }
Server::~Server() = default;
int Server::port() const { return 0; }
void Server::run(Served) {}

}  // namespace rainref::cli
