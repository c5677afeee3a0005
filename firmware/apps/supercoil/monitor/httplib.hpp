// cpp-httplib, without a macro of <resolv.h> that conflicts with Eigen's names.
#pragma once

#include <httplib.h>
#undef _res
