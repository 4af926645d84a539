// SPDX-License-Identifier: GPL-3.0-or-later
// What nearly every file reads: the compiler reads it once. Files still include what they use: without
// precompiled headers (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON) they compile as they stand.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>
