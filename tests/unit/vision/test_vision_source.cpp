#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "core/errors.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vision/source/frame_source.hpp"
#include "vision/source/image_file.hpp"
#include "vision/source/live_camera.hpp"
#include "vision/source/make_camera.hpp"

namespace vpdr::vision {
namespace {

using vpdr::testing::TemporaryFolder;

cv::Mat corridor(double heading = 0.1) {
  return testing::draw_corridor(CameraModel(testing::plain_camera()),
                                testing::looking(heading, 0.0, 0.0));
}

std::string encoded(const std::string& extension) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, corridor(), bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(ReadImage, GivesGreyPixels) {
  const TemporaryFolder folder;
  const auto png = read_image(folder.write("a.png", encoded(".png")));
  ASSERT_TRUE(png);
  EXPECT_EQ(cv::norm(png.value(), corridor(), cv::NORM_INF), 0.0);
  const auto jpeg = read_image(folder.write("a.jpg", encoded(".jpg") + std::string(100, '\0')));
  ASSERT_TRUE(jpeg);
  EXPECT_EQ(jpeg.value().type(), CV_8UC1);
}

TEST(ReadImage, NamesWhatCannotBeRead) {
  const TemporaryFolder folder;
  const auto message = [](const Result<cv::Mat>& r) { return r ? "" : r.error().message; };
  EXPECT_NE(
      message(read_image(folder.path() / "none.png")).find("none.png: image cannot be opened"),
      std::string::npos);
  EXPECT_NE(message(read_image(folder.write("e.png", ""))).find("e.png: image is empty"),
            std::string::npos);
  EXPECT_NE(message(read_image(folder.write("x.png", "no image at all"))).find("does not decode"),
            std::string::npos);
  for (const char* extension : {".png", ".jpg"}) {
    const std::string whole = encoded(extension);
    const std::string name = std::string("torn") + extension;
    for (const double share : {0.1, 0.5, 0.95}) {
      const auto part = whole.substr(0, static_cast<std::size_t>(share * whole.size()));
      EXPECT_NE(message(read_image(folder.write(name, part))).find(name + ": image is torn"),
                std::string::npos);
    }
  }
}

TEST(ImageListSource, GivesEveryFrameInOrderTheBadOnesEmpty) {
  const TemporaryFolder folder;
  const auto source = make_image_list_source({{10, folder.write("a.png", encoded(".png"))},
                                              {20, folder.write("b.png", "rubbish")},
                                              {30, folder.write("c.png", encoded(".png"))}});
  EXPECT_EQ(source->next_stamp(), 10);
  EXPECT_FALSE(source->load().image.empty());
  EXPECT_EQ(source->next_stamp(), 20);
  const Frame bad = source->load();
  EXPECT_EQ(bad.stamp_ns, 20);
  EXPECT_TRUE(bad.image.empty());
  EXPECT_NE(bad.problem.find("b.png"), std::string::npos);
  EXPECT_FALSE(source->load().image.empty());
  EXPECT_FALSE(source->next_stamp());
}

TEST(VideoSource, StampsByTheFilesOwnRate) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "walk.avi";
  {
    cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 20.0,
                           {640, 480}, false);
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < 3; ++i) writer.write(corridor(0.1 * i));
  }
  const auto source = make_video_source(file, 1'000'000'000);
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(source->next_stamp(), 1'000'000'000 + i * 50'000'000);
    const Frame frame = source->load();
    EXPECT_EQ(frame.image.type(), CV_8UC1);
    EXPECT_EQ(frame.image.cols, 640);
  }
  EXPECT_FALSE(source->next_stamp());
  EXPECT_THROW(make_video_source(folder.write("no.avi", "rubbish"), 0), FileFault);
}

TEST(MakeCamera, TakesOverEveryModel) {
  dataset::CameraCalibration c;
  c.fx = 400.0;
  c.fy = 410.0;
  c.cx = 320.0;
  c.cy = 240.0;
  c.width = 640;
  c.height = 480;
  c.distortion = dataset::Distortion::kRadialTangential;
  c.coefficients = {0.1, -0.2, 0.01, 0.02};
  c.body_from_camera.topLeftCorner<3, 3>() = forward_looking_body_from_camera();
  EXPECT_EQ(make_camera(c).parameters().height_m, 0.0);
  c.height_m = 1.6;
  const CameraParameters p = make_camera(c).parameters();
  EXPECT_EQ(p.height_m, 1.6);
  EXPECT_EQ(p.distortion, Distortion::kRadialTangential);
  EXPECT_EQ(p.fy_px, 410.0);
  EXPECT_EQ(p.width_px, 640);
  EXPECT_EQ(p.coefficients, (std::array<double, 5>{0.1, -0.2, 0.01, 0.02, 0.0}));
  EXPECT_EQ(p.body_from_camera, forward_looking_body_from_camera());
  c.coefficients = {0.1, -0.2, 0.01, 0.02, 0.0, 0.0, 0.0, 0.0};
  EXPECT_NO_THROW(make_camera(c));
  c.coefficients[5] = 0.3;
  EXPECT_THROW(make_camera(c), FileFault);
  c.coefficients.clear();
  c.fx = 0.0;
  EXPECT_THROW(make_camera(c), FileFault);
}

/// A camera that gives what the test lets it: a frame for each release, failure after `fail`.
class ScriptedGrabber : public Grabber {
 public:
  struct Script {
    std::mutex mutex;
    std::condition_variable changed;
    int released = 0;
    int grabbed = 0;
    int openings = 0;
    bool absent = false;
    bool failing = false;  ///< the next grab() fails
    bool closed = false;   ///< every grab() fails
    void set(const std::function<void(Script&)>& change) {
      const std::lock_guard lock(mutex);
      change(*this);
      changed.notify_all();
    }
    template <class Condition>
    void wait(Condition condition) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return condition(*this); });
    }
  };
  explicit ScriptedGrabber(Script& script) : script_(script) {}

  bool open() override {
    const std::lock_guard lock(script_.mutex);
    ++script_.openings;
    script_.changed.notify_all();
    return !script_.absent;
  }
  bool grab(cv::Mat& image) override {
    std::unique_lock lock(script_.mutex);
    script_.changed.wait(lock, [this] {
      return script_.closed || script_.failing || script_.grabbed < script_.released;
    });
    if (script_.closed || script_.failing) {
      script_.failing = false;
      return false;
    }
    ++script_.grabbed;
    script_.changed.notify_all();
    image = cv::Mat(2, 2, CV_8UC1, cv::Scalar(script_.grabbed));
    return true;
  }

 private:
  Script& script_;
};

TEST(LiveCamera, KeepsTheNewestFrameDropsTheOthersAndComesBack) {
  ScriptedGrabber::Script script;
  std::atomic<TimestampNs> now{1'000'000'000};
  LiveCameraOptions options;
  options.clock = [&now] { return now.load(); };
  options.latency_s = 0.03;
  options.retry = std::chrono::milliseconds(1);
  {
    LiveCamera camera(std::make_unique<ScriptedGrabber>(script), options);
    std::stop_source stop;
    // Waiting on the counter of the camera itself: grabbed and kept.
    const auto grab = [&](int frames) {
      script.set([&](auto& s) { s.released += frames; });
      while (camera.health().frames < static_cast<std::uint64_t>(script.released)) {
        std::this_thread::yield();
      }
    };
    grab(3);
    const auto frame = camera.take(stop.get_token());
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->image.at<std::uint8_t>(0, 0), 3);
    EXPECT_EQ(frame->stamp_ns, 970'000'000);
    EXPECT_EQ(camera.health().dropped, 2U);
    EXPECT_TRUE(camera.health().connected);

    script.set([](auto& s) { s.failing = true; });
    script.wait([](auto& s) { return s.openings >= 2; });
    grab(1);
    EXPECT_EQ(camera.take(stop.get_token())->image.at<std::uint8_t>(0, 0), 4);
    EXPECT_EQ(camera.health().reconnections, 1U);

    stop.request_stop();
    EXPECT_FALSE(camera.take(stop.get_token()));
    script.set([](auto& s) { s.closed = true; });
  }
  EXPECT_GE(script.openings, 2);
}

TEST(LiveCamera, AnAbsentCameraIsTriedAgain) {
  ScriptedGrabber::Script script;
  script.absent = true;
  LiveCameraOptions options;
  options.clock = [] { return TimestampNs{0}; };
  options.retry = std::chrono::milliseconds(1);
  const LiveCamera camera(std::make_unique<ScriptedGrabber>(script), options);
  script.wait([](auto& s) { return s.openings >= 3; });
  EXPECT_FALSE(camera.health().connected);
  EXPECT_EQ(camera.health().reconnections, 0U);
}

}  // namespace
}  // namespace vpdr::vision
