#include "pdr/core/height/vertical_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/square.hpp"

namespace vpdr::pdr {

namespace {

/// Time that a jump of the pressure goes on.
constexpr double kJumpTime = 0.5;
/// Time that is passed in one piece, and the number of them, at most.
constexpr double kPiece = 2.0;
constexpr double kMostPieces = 100.0;
/// No model is ever out of the running.
constexpr double kLeastProbability = 1e-6;

/// Share of a process that is left after a time.
double kept(double dt_s, double time_s) { return std::exp(-dt_s / time_s); }

}  // namespace

void VerticalFilter::start(double height_m, double variance_m2, double reading_m, double noise_m2) {
  const double gust = square(config_.gust_sigma_m);
  Model model;
  model.x[kHeight] = height_m;
  model.p(kHeight, kHeight) = variance_m2;
  model.x[kWeather] = reading_m - height_m;
  model.p(kWeather, kWeather) = variance_m2 + gust + noise_m2;
  model.p(kHeight, kWeather) = model.p(kWeather, kHeight) = -variance_m2;
  model.p(kGust, kGust) = gust;
  model.p(kGust, kWeather) = model.p(kWeather, kGust) = -gust;
  models_.fill(model);
  models_[kLevel].probability = 1.0;
  combine();
}

void VerticalFilter::add(double reading_m, double noise_m2, double dt_s, bool walking) {
  // A climb may begin and end within a silence, so it is passed in pieces.
  const double pieces = std::clamp(std::ceil(dt_s / kPiece), 1.0, kMostPieces);
  for (int piece = 0; piece < static_cast<int>(pieces); ++piece) pass(dt_s / pieces, walking);
  double sum = 0.0;
  for (Model& model : models_) {
    model.probability *= correct(model, reading_m, noise_m2);
    sum += model.probability;
  }
  for (Model& model : models_) {
    model.probability = std::max(sum > 0.0 ? model.probability / sum : 1.0, kLeastProbability);
  }
  combine();
}

void VerticalFilter::pass(double dt_s, bool walking) {
  mix(switching(dt_s));
  for (const ModelIndex index : kAll) predict(index, dt_s, walking);
}

/// Row: the model before; column: the model after dt. A Markov chain in continuous time, to first
/// order in the rarer switches. A door that slammed during a silence has come to rest by its end.
VerticalFilter::Switching VerticalFilter::switching(double dt_s) const {
  const double jump = 1.0 - kept(std::min(dt_s, 2.0 * kJumpTime), config_.jump_every_s);
  const double climb = 0.5 * (1.0 - jump) * (1.0 - kept(dt_s, config_.level_time_s));
  const double arrive = (1.0 - jump) * (1.0 - kept(dt_s, config_.climb_time_s));
  const double calm = 1.0 - kept(dt_s, kJumpTime);
  Switching p;
  p << 1.0 - 2.0 * climb - jump, climb, climb, jump,     //
      arrive, 1.0 - arrive - jump, 0.0, jump,            //
      arrive, 0.0, 1.0 - arrive - jump, jump,            //
      0.9 * calm, 0.05 * calm, 0.05 * calm, 1.0 - calm;  //
  return p;
}

/// Each model starts from all of them, weighed by how likely they led to it.
void VerticalFilter::mix(const Switching& switching) {
  const Models before = models_;
  for (const ModelIndex to : kAll) {
    Model& model = models_[to];
    model = Model{};
    for (const ModelIndex from : kAll) {
      const double share = switching(from, to) * before[from].probability;
      model.probability += share;
      model.x += share * before[from].x;
    }
    model.x /= model.probability;
    for (const ModelIndex from : kAll) {
      const double share = switching(from, to) * before[from].probability / model.probability;
      const Vector apart = before[from].x - model.x;
      model.p += share * (before[from].p + apart * apart.transpose());
    }
  }
}

void VerticalFilter::predict(ModelIndex index, double dt_s, bool walking) {
  Model& model = models_[index];
  const double gust = kept(dt_s, config_.gust_time_s);
  model.x[kGust] *= gust;
  model.p.row(kGust) *= gust;
  model.p.col(kGust) *= gust;
  model.p(kGust, kGust) += square(config_.gust_sigma_m) * (1.0 - square(gust));
  model.p(kWeather, kWeather) += square(config_.weather_m_sqrt_s) * dt_s;
  if (index == kLevel) {
    model.x[kSpeed] = 0.0;
    model.p.row(kSpeed).setZero();
    model.p.col(kSpeed).setZero();
    if (walking) model.p(kHeight, kHeight) += square(config_.floor_m_sqrt_s) * dt_s;
  } else if (index == kDisturbed) {
    Matrix f = Matrix::Identity();
    f(kHeight, kSpeed) = dt_s;
    model.x = (f * model.x).eval();
    model.p = (f * model.p * f.transpose()).eval();
    model.p(kGust, kGust) += square(config_.jump_m);
    model.p(kWeather, kWeather) += square(config_.lasting_jump_m);
  } else {
    const double mean = walking ? config_.stairs_mps : config_.lift_mps;
    climb(model, index == kUp ? mean : -mean,
          walking ? config_.stairs_sigma_mps : config_.lift_sigma_mps, dt_s);
  }
}

/// Integral of a first-order Gauss-Markov speed, exact over any time.
void VerticalFilter::climb(Model& model, double mean_mps, double sigma_mps, double dt_s) const {
  const double time = config_.speed_time_s;
  const double variance = square(sigma_mps);
  const double a = kept(dt_s, time);
  Matrix f = Matrix::Identity();
  f(kSpeed, kSpeed) = a;
  f(kHeight, kSpeed) = time * (1.0 - a);
  Matrix q = Matrix::Zero();
  q(kSpeed, kSpeed) = variance * (1.0 - a * a);
  q(kHeight, kSpeed) = q(kSpeed, kHeight) = variance * time * square(1.0 - a);
  q(kHeight, kHeight) = variance * square(time) * (2.0 * dt_s / time - 3.0 + 4.0 * a - a * a);
  model.x[kSpeed] -= mean_mps;
  model.x = (f * model.x).eval();
  model.x[kHeight] += mean_mps * dt_s;
  model.x[kSpeed] += mean_mps;
  model.p = (f * model.p * f.transpose()).eval() + q;
}

double VerticalFilter::correct(Model& model, double reading_m, double noise_m2) {
  Vector row = Vector::Ones();
  row[kSpeed] = 0.0;
  const Vector projected = model.p * row;
  const double spread = row.dot(projected) + noise_m2;
  const double innovation = reading_m - row.dot(model.x);
  model.x += projected * (innovation / spread);
  model.p -= projected * projected.transpose() / spread;
  return std::exp(-0.5 * square(innovation) / spread) / std::sqrt(spread);
}

void VerticalFilter::combine() {
  double sum = 0.0;
  for (const Model& model : models_) sum += model.probability;
  mean_.setZero();
  covariance_.setZero();
  for (Model& model : models_) {
    model.probability /= sum;
    mean_ += model.probability * model.x;
  }
  for (const Model& model : models_) {
    const Vector apart = model.x - mean_;
    covariance_ += model.probability * (model.p + apart * apart.transpose());
  }
}

}  // namespace vpdr::pdr
