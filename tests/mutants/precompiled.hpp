// Headers that most files of the firmware and its tests include and that no mutant changes.
#ifdef EIGEN_DONT_VECTORIZE  // defined for the targets that use control
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <supercoil/control/estimation/estimator.hpp>
#include <supercoil/control/thermal/interval_observer.hpp>
#include <supercoil/control/thermal/rise_interval_observer.hpp>
#include <supercoil/control/tracking/controller.hpp>
#include <thread>
#include <tuple>
#include <variant>
#include <vector>

#include <boost/lockfree/spsc_queue.hpp>
#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>
#endif
