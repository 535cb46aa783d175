#include "vpdr/camera/board_images.hpp"

#include <algorithm>
#include <cstdio>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "vision/source/image_file.hpp"

namespace vpdr::tool {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  const int size = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(static_cast<std::size_t>(size), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

// A cell's corners as one character: none, few, some, many.
char mark_of(int corners) {
  return corners == 0 ? '.' : corners < 5 ? '-' : corners < 20 ? '+' : '#';
}

std::string map_of(const vision::Coverage& coverage) {
  std::string text =
      format("coverage: corners in %.0f %% of the image's cells\n", 100.0 * coverage.share);
  for (int row = 0; row < vision::Coverage::kRows; ++row) {
    text += "  ";
    for (int column = 0; column < vision::Coverage::kColumns; ++column) {
      text += mark_of(
          coverage.cells[static_cast<std::size_t>(row * vision::Coverage::kColumns + column)]);
    }
    text += "\n";
  }
  if (coverage.share < 0.7) {
    text += "  the empty cells (.) are extrapolated: take images with the board there\n";
  }
  return text;
}

}  // namespace

BoardImages find_boards(const std::vector<std::filesystem::path>& files,
                        const vision::Chessboard& board,
                        const std::function<void(double)>& progress) {
  BoardImages found;
  std::size_t done = 0;
  for (const std::filesystem::path& file : files) {
    const auto image = vision::read_image(file);
    progress(static_cast<double>(++done) / static_cast<double>(files.size()));
    if (!image) {
      found.without.push_back(image.error().message);
      continue;
    }
    const cv::Size size = image.value().size();
    if (found.size.empty()) found.size = size;
    if (size != found.size) {
      throw FileFault(file.string() + ": is " + size_text(size) + ", the images before it " +
                      size_text(found.size) + "; give the images of one camera");
    }
    if (auto corners = vision::find_corners(image.value(), board)) {
      found.views.push_back({file.filename().string(), std::move(*corners)});
    } else {
      found.without.push_back(file.filename().string() + ": the board is not wholly seen");
    }
  }
  return found;
}

vision::FloorView floor_in(const std::filesystem::path& file, const vision::Chessboard& board,
                           const vision::CameraModel& camera) {
  const auto image = vision::read_image(file);
  if (!image) throw FileFault(image.error().message);
  const vision::CameraParameters& p = camera.parameters();
  if (image.value().cols != p.width_px || image.value().rows != p.height_px) {
    throw FileFault(file.string() + ": is " + size_text(image.value().size()) +
                    ", the camera is calibrated for " + size_text({p.width_px, p.height_px}) +
                    "; take it with the same settings");
  }
  const auto corners = vision::find_corners(image.value(), board);
  const auto floor = corners ? vision::measure_floor(*corners, board, camera) : std::nullopt;
  if (!floor) {
    throw FileFault(file.string() +
                    ": the board on the floor is not seen; it must be wholly in view, a few metres "
                    "ahead at most");
  }
  return *floor;
}

std::string describe(const vision::IntrinsicsCalibration& c) {
  const vision::CameraParameters& p = c.camera;
  std::string text = format(
      "fx %.3f +- %.3f px, fy %.3f +- %.3f px, cx %.3f +- %.3f px, cy %.3f +- %.3f px\n", p.fx_px,
      c.sigma.fx_px, p.fy_px, c.sigma.fy_px, p.cx_px, c.sigma.cx_px, p.cy_px, c.sigma.cy_px);
  const bool fisheye = p.distortion == vision::Distortion::kEquidistant;
  const auto names =
      fisheye ? std::array{"k1", "k2", "k3", "k4", ""} : std::array{"k1", "k2", "p1", "p2", "k3"};
  text += fisheye ? "equidistant:" : "radial-tangential:";
  for (std::size_t i = 0; i < p.coefficients.size(); ++i) {
    if (i == 4 && p.coefficients[i] == 0.0) continue;
    text += format(" %s %.5f +- %.5f", names[i], p.coefficients[i], c.sigma.coefficients[i]);
  }
  const auto dropped = std::count_if(c.views.begin(), c.views.end(),
                                     [](const vision::ViewResidual& v) { return v.dropped; });
  text += format("\nRMS %.3f px over %zu views, %td dropped\n", c.rms_px,
                 c.views.size() - static_cast<std::size_t>(dropped), dropped);
  for (const vision::ViewResidual& v : c.views) {
    text += format("  %-24s %.3f px%s\n", v.name.c_str(), v.rms_px,
                   v.dropped ? "  dropped: does not fit the others" : "");
  }
  return text + map_of(c.coverage);
}

std::string describe(const vision::FloorView& floor) {
  return format(
      "camera %.3f m +- %.3f m above the floor, pitch %.2f deg (up positive), roll %.2f deg; RMS "
      "%.3f px; with the rotation taken as none, as printed: %.3f m\n",
      floor.height_m, floor.height_sigma_m, to_degrees(floor.pitch_rad), to_degrees(floor.roll_rad),
      floor.rms_px, floor.printed_height_m);
}

dataset::CameraCalibration to_file(const vision::CameraParameters& p) {
  dataset::CameraCalibration c;
  c.fx = p.fx_px;
  c.fy = p.fy_px;
  c.cx = p.cx_px;
  c.cy = p.cy_px;
  c.width = p.width_px;
  c.height = p.height_px;
  c.distortion = p.distortion == vision::Distortion::kEquidistant
                     ? dataset::Distortion::kEquidistant
                     : dataset::Distortion::kRadialTangential;
  const std::size_t count = p.coefficients[4] == 0.0 ? 4 : 5;
  c.coefficients.assign(p.coefficients.begin(),
                        p.coefficients.begin() + static_cast<std::ptrdiff_t>(count));
  return c;
}

}  // namespace vpdr::tool
