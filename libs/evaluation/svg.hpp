#pragma once
// SVG drawing as text. Colours and line styles are CSS classes (report_style.hpp), so that one
// figure suits light, dark and paper. Coordinates are pixels, y down.
#include <string>
#include <string_view>
#include <vector>

namespace vpdr::evaluation {

/// A place on the canvas. Not-finite points break a line.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// `text` with & < > " ' replaced for XML and HTML.
std::string escaped(std::string_view text);

/// `value` with at most `decimals` decimals and no trailing zeros: "1.5", "12", "-0.25".
std::string short_number(double value, int decimals);

/// `value` with exactly `decimals` decimals.
std::string fixed_number(double value, int decimals);

enum class Anchor { kStart, kMiddle, kEnd };

/// One figure. Elements are drawn in the order of the calls. A `tooltip` shows on hover.
class Svg {
 public:
  /// `label` is what a screen reader says of the figure.
  Svg(double width, double height, std::string_view label);

  void line(Point from, Point to, std::string_view css_class);
  /// A line through the points, broken where one is not finite.
  void path(const std::vector<Point>& points, std::string_view css_class,
            std::string_view tooltip = {});
  /// A filled outline.
  void area(const std::vector<Point>& outline, std::string_view css_class);
  void circle(Point centre, double radius, std::string_view css_class,
              std::string_view tooltip = {});
  void rect(Point corner, double width, double height, std::string_view css_class,
            std::string_view tooltip = {});
  /// Radii along the ellipse's own axes; the first axis is turned `angle_deg` clockwise on screen.
  void ellipse(Point centre, double radius_1, double radius_2, double angle_deg,
               std::string_view css_class, std::string_view tooltip = {});
  void text(Point at, std::string_view text, std::string_view css_class,
            Anchor anchor = Anchor::kStart, double turn_deg = 0.0);
  /// What follows, until end_clip, shows only inside the rectangle.
  void begin_clip(Point corner, double width, double height);
  void end_clip();

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }

  /// The <svg> element, to stand inside a page that brings the style.
  [[nodiscard]] std::string inline_element() const;
  /// A file of its own, with `css` inside.
  [[nodiscard]] std::string document(std::string_view css) const;

 private:
  void shape(const std::string& element, std::string_view css_class, std::string_view tooltip);
  [[nodiscard]] std::string head() const;

  double width_;
  double height_;
  std::string label_;
  std::string body_;
  int clips_ = 0;
  std::string clip_prefix_;
};

}  // namespace vpdr::evaluation
