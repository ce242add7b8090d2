#include "points.hpp"

#include <optional>
#include <string>

namespace vspring {

Points::Points(const val& bytes, const std::string& name) {
  forwarding_errors([&] {
    points_ = read_points_bytes(bytes.as<std::string>(), name);
    // Degrees would need the plane of the curve.
    if (points_.plane)
      throw Error(
          ErrorCode::unusable_file,
          name + ": gives latitudes and longitudes, which points cannot have here; fit them on the command line");
  });
}

Points Points::at(const val& positions) {
  return Points(ScatteredPoints{.positions = forwarding_errors([&] { return vectors_of(positions); })});
}

FitOptions options_of(const val& settings) {
  check_names(settings, {"weight", "smoothingLength", "within", "rms", "outliers", "leastRadius", "sharp", "keep"});
  const auto number = [&](const char* key) -> std::optional<double> {
    const val value = settings[key];
    if (value.isNull() || value.isUndefined()) return std::nullopt;
    return value.as<double>();
  };
  FitOptions options;
  int given = 0;
  const auto take = [&](const char* key, const auto& criterion_of) {
    const std::optional<double> value = number(key);
    if (!value) return;
    options.criterion = criterion_of(*value);
    ++given;
  };
  take("weight", [](double value) { return Weight{value}; });
  take("smoothingLength", [](double value) { return SmoothingLength{value}; });
  take("within", [](double value) { return Within{value}; });
  take("rms", [](double value) { return RootMeanSquare{value}; });
  if (given != 1)
    throw Error(ErrorCode::invalid_argument, std::string(given == 0 ? "one" : "only one") +
                                                 " of weight, smoothingLength, within and rms has to be given");
  options.outliers = number("outliers").value_or(0);
  options.sharp = number("sharp").value_or(0);
  options.least_radius = number("leastRadius").value_or(0);
  if (const val keep = settings["keep"]; keep.isTrue()) options.fair.distribution = Distribution::keep;
  return options;
}

val to_val(const FitResult& result) {
  const FitReport& report = result.report;
  val figures = val::object();
  figures.set("points", report.points);
  figures.set("pullingPoints", report.pulling_points);
  figures.set("outliers", report.outliers);
  figures.set("smoothingLength", report.smoothing_length ? val(*report.smoothing_length) : val::null());
  figures.set("leastRadius", report.least_radius ? val(*report.least_radius) : val::null());
  figures.set("sharpestNode", report.sharpest_node);
  figures.set("greatest", report.after.all.greatest);
  figures.set("rms", report.after.all.rms);
  val all = to_val(report.fair);
  all.set("fit", figures);
  if (!result.distances.empty())
    all.set("distances", array_of("Float64Array", result.distances.size(), result.distances.data()));
  return all;
}

}  // namespace vspring

EMSCRIPTEN_BINDINGS(vspring_points) {
  emscripten::class_<vspring::Points>("Points")
      .constructor<vspring::val, std::string>()
      .class_function("at", &vspring::Points::at)
      .function("positions", &vspring::Points::positions)
      .function("weighted", &vspring::Points::weighted);
}
