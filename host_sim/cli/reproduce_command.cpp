#include "cli/commands.hpp"
namespace supercoil::host_sim { int reproduce_command(const ReproduceOptions&){return 1;} }
