// cpp-httplib, without a macro of <resolv.h> that Eigen's own names run into.
#pragma once

#include <httplib.h>
#undef _res
