#include "app/service_loop.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>

#include "app/diagnostics.hpp"
#include "core/errors.hpp"

namespace vpdr::app {
namespace {

constexpr timespec kTick{0, 50'000'000};
constexpr std::chrono::seconds kReportEvery{1};
constexpr std::chrono::seconds kSayWhatIsMissingAfter{5};
constexpr std::chrono::seconds kHandOverTimeout{5};

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

}  // namespace

void refuse_second_instance(const dds::Participant& participant) {
  if (!participant.is_duplicate()) return;
  const auto& options = participant.options();
  throw DdsFault("a " + options.service + " runs already for walker " + options.walker +
                 " in domain " + std::to_string(options.domain) +
                 "; stop it, or give this one another --walker or --domain");
}

ServiceLoop::ServiceLoop(ServiceContext& context, Service& service)
    : context_(context),
      service_(service),
      diagnostics_(std::make_unique<dds::Publisher<diagnostic_msgs::msg::DiagnosticArray>>(
          context.participant(), dds::topics::kDiagnostics)),
      peers_(context.participant()) {}

bool ServiceLoop::signalled() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return sigtimedwait(&signals, nullptr, &kTick) > 0;
}

ExitCode ServiceLoop::run() {
  waiting_since_ = Clock::now();
  while (!signalled()) {
    refuse_second_instance(context_.participant());
    report_problems();
    peers_.refresh();
    advance_start();
    if (Clock::now() >= next_report_) {
      next_report_ = Clock::now() + kReportEvery;
      publish_health(matched_ ? ServiceState::kRunning : ServiceState::kWaiting);
    }
    if (context_.stop_request() || walk_over()) break;
  }
  return leave();
}

void ServiceLoop::report_problems() {
  for (const auto& problem : context_.participant().take_problems()) {
    spdlog::error("{}{}{}", problem.topic, problem.topic.empty() ? "" : ": ", problem.text);
  }
}

void ServiceLoop::advance_start() {
  if (started_) return;
  const auto& wait_for = context_.common().wait_for;
  if (!matched_ && context_.matched()) {
    matched_ = true;
    next_report_ = Clock::now();  // the others wait for this news
  }
  // The source of the walk begins only when the others are matched among themselves too.
  if (matched_ && (!service_.upstream().empty() || peers_.all_running(wait_for))) {
    started_ = true;
    spdlog::info("running");
    service_.start();
  } else if (waiting_since_ && Clock::now() - *waiting_since_ > kSayWhatIsMissingAfter) {
    spdlog::info("waiting for {}", joined(wait_for));
    waiting_since_.reset();
  }
}

bool ServiceLoop::walk_over() {
  if (!context_.common().until_end || !started_) return false;
  if (service_.at_end()) return true;
  std::vector<std::string> upstream = service_.upstream();
  if (upstream.empty()) return false;
  return std::all_of(upstream.begin(), upstream.end(), [this](const std::string& service) {
    // An optional service that never came is not waited for.
    const bool expected = context_.waits_for(service);
    const auto seen = peers_.seen();
    const bool known = std::find(seen.begin(), seen.end(), service) != seen.end();
    return known ? peers_.over(service) : !expected && service != "imu_gateway";
  });
}

void ServiceLoop::publish_health(ServiceState at_least) {
  Health health;
  health.state = at_least;
  service_.report(health);
  if (at_least != ServiceState::kRunning) {
    health.state = at_least;
  } else if (const auto line = health_log_.see(health)) {
    spdlog::log(line->warning ? spdlog::level::warn : spdlog::level::info, "{}", line->text);
  }
  diagnostics_->publish(
      to_diagnostics(health, context_.participant().options().service, context_.common().walker));
}

ExitCode ServiceLoop::leave() {
  service_.close();
  // One that never took part has not finished the walk of those that did.
  if (started_) publish_health(ServiceState::kFinished);
  diagnostics_->wait_for_acknowledgments(kHandOverTimeout);
  const auto stop = context_.stop_request();
  if (stop && stop->code != ExitCode::kOk) {
    spdlog::error("{}", stop->reason);
    return stop->code;
  }
  const auto upstream = service_.upstream();
  for (const std::string& service : upstream) {
    if (context_.common().until_end && peers_.lost(service)) {
      spdlog::warn("{} left without finishing; what had come until then is kept", service);
    }
  }
  return ExitCode::kOk;
}

}  // namespace vpdr::app
