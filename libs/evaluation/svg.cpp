#include "evaluation/svg.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace vpdr::evaluation {
namespace {

/// A tenth of a pixel is finer than any screen or printer shows.
std::string px(double value) { return short_number(value, 1); }

std::string attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + px(value) + "\"";
}

bool finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string pair(const Point& p) { return px(p.x) + " " + px(p.y); }

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string fixed_number(double value, int decimals) {
  std::array<char, 400> text{};
  const int n = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return {text.data(), static_cast<std::size_t>(n)};
}

std::string short_number(double value, int decimals) {
  std::string text = fixed_number(value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

Svg::Svg(double width, double height, std::string_view label)
    : width_(width), height_(height), label_(label) {
  // Several figures share one page, and clip paths are named page-wide.
  clip_prefix_ = "clip" + std::to_string(std::hash<std::string_view>{}(label) % 1000000) + "_";
}

void Svg::shape(const std::string& element, std::string_view css_class, std::string_view tooltip) {
  body_ += "<" + element + " class=\"" + std::string(css_class) + "\"";
  const std::string name = element.substr(0, element.find(' '));
  if (tooltip.empty()) {
    body_ += "/>\n";
  } else {
    body_ += "><title>" + escaped(tooltip) + "</title></" + name + ">\n";
  }
}

void Svg::line(Point from, Point to, std::string_view css_class) {
  shape("line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
            attribute("y2", to.y),
        css_class, {});
}

void Svg::path(const std::vector<Point>& points, std::string_view css_class,
               std::string_view tooltip) {
  std::string data;
  bool pen_down = false;
  for (const Point& p : points) {
    if (!finite(p)) {
      pen_down = false;
      continue;
    }
    data += (pen_down ? "L" : "M") + pair(p);
    pen_down = true;
  }
  if (!data.empty()) shape("path d=\"" + data + "\"", css_class, tooltip);
}

void Svg::area(const std::vector<Point>& outline, std::string_view css_class) {
  std::string data;
  for (const Point& p : outline) {
    if (finite(p)) data += (data.empty() ? "M" : "L") + pair(p);
  }
  if (!data.empty()) shape("path d=\"" + data + "Z\"", css_class, {});
}

void Svg::circle(Point centre, double radius, std::string_view css_class,
                 std::string_view tooltip) {
  shape("circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius),
        css_class, tooltip);
}

void Svg::rect(Point corner, double width, double height, std::string_view css_class,
               std::string_view tooltip) {
  shape("rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
            attribute("height", height),
        css_class, tooltip);
}

void Svg::ellipse(Point centre, double radius_1, double radius_2, double angle_deg,
                  std::string_view css_class, std::string_view tooltip) {
  shape("ellipse" + attribute("rx", radius_1) + attribute("ry", radius_2) +
            " transform=\"translate(" + pair(centre) + ") rotate(" + px(angle_deg) + ")\"",
        css_class, tooltip);
}

void Svg::text(Point at, std::string_view text, std::string_view css_class, Anchor anchor,
               double turn_deg) {
  constexpr std::array<const char*, 3> kAnchors = {"start", "middle", "end"};
  body_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + " text-anchor=\"" +
           kAnchors[static_cast<std::size_t>(anchor)] + "\" class=\"" + std::string(css_class) +
           "\"";
  if (turn_deg != 0.0) body_ += " transform=\"rotate(" + px(turn_deg) + " " + pair(at) + ")\"";
  body_ += ">" + escaped(text) + "</text>\n";
}

void Svg::begin_clip(Point corner, double width, double height) {
  const std::string id = clip_prefix_ + std::to_string(clips_++);
  body_ += "<clipPath id=\"" + id + "\"><rect" + attribute("x", corner.x) +
           attribute("y", corner.y) + attribute("width", width) + attribute("height", height) +
           "/></clipPath>\n<g clip-path=\"url(#" + id + ")\">\n";
}

void Svg::end_clip() { body_ += "</g>\n"; }

std::string Svg::head() const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(width_) + " " +
         px(height_) + "\" role=\"img\" aria-label=\"" + escaped(label_) + "\"";
}

std::string Svg::inline_element() const { return head() + ">\n" + body_ + "</svg>\n"; }

std::string Svg::document(std::string_view css) const {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + head() + attribute("width", width_) +
         attribute("height", height_) + ">\n<style>" + std::string(css) +
         "</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n" + body_ + "</svg>\n";
}

}  // namespace vpdr::evaluation
