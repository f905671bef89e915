// How the mathematical functions of two systems differ: `functions` writes their values at a million places
// each, and `functions FILE` compares its own with those of a file. See docs/developers/systems.md.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

struct Function {
  const char* name;
  double low, high;
  std::function<double(double)> value;
};

const std::vector<Function>& functions() {
  using D = double (*)(double);
  static const std::vector<Function> kAll = {
      {"sqrt", 0, 100, D(std::sqrt)},
      {"sin", -10, 10, D(std::sin)},
      {"cos", -10, 10, D(std::cos)},
      {"tan", -1.5, 1.5, D(std::tan)},
      {"asin", -1, 1, D(std::asin)},
      {"acos", -1, 1, D(std::acos)},
      {"atan", -10, 10, D(std::atan)},
      {"atan2", -1, 1, [](double x) { return std::atan2(x, 0.3 - 0.7 * x); }},
      {"exp", -15, 5, D(std::exp)},
      {"exp2", -15, 5, D(std::exp2)},
      {"expm1", -1, 1, D(std::expm1)},
      {"log", 0, 10, D(std::log)},
      {"log2", 0, 10, D(std::log2)},
      {"log10", 0, 10, D(std::log10)},
      {"log1p", 0, 10, D(std::log1p)},
      {"pow", 0, 1, [](double x) { return std::pow(x, 2.2); }},
      {"cbrt", 0, 10, D(std::cbrt)},
      {"hypot", 0, 1, [](double x) { return std::hypot(x, 1 - x); }},
      {"sinh", -2, 2, D(std::sinh)},
      {"cosh", -2, 2, D(std::cosh)},
      {"tanh", -2, 2, D(std::tanh)},
      {"erf", -2, 2, D(std::erf)},
      {"fmod", 0, 100, [](double x) { return std::fmod(x, 0.37); }},
      {"fma", 0, 1, [](double x) { return std::fma(x, x, -x); }},
  };
  return kAll;
}

/// The values at places that are spread evenly.
std::vector<double> valuesOf(const Function& function) {
  constexpr int kCount = 1000000;
  std::vector<double> values;
  std::uint64_t place = 1;
  for (int i = 0; i < kCount; ++i) {
    place += 0x9e3779b97f4a7c15u;  // a turn by the golden ratio
    const double share = static_cast<double>(place >> 11) * 0x1p-53;
    values.push_back(function.value(function.low + share * (function.high - function.low)));
  }
  return values;
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "rb") : nullptr;
  if (argc > 1 && !file) return 1;
  for (const Function& function : functions()) {
    const std::vector<double> values = valuesOf(function);
    if (!file) {
      std::fwrite(values.data(), sizeof(double), values.size(), stdout);
      continue;
    }
    std::vector<double> others(values.size());
    if (std::fread(others.data(), sizeof(double), others.size(), file) != others.size()) return 1;
    int differ = 0;
    std::int64_t most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::int64_t ulps =
          std::bit_cast<std::int64_t>(values[i]) - std::bit_cast<std::int64_t>(others[i]);
      differ += ulps != 0;
      most = std::max(most, ulps < 0 ? -ulps : ulps);
    }
    std::printf("%-6s %8.4f %% differ, by at most %lld units in the last place\n", function.name,
                100.0 * differ / static_cast<double>(values.size()), static_cast<long long>(most));
  }
  return 0;
}
