/* Another vendor's view of a walker: reads imu/data_raw and fusion/pose with Cyclone DDS, by types
 * that idlc made from the same .idl files, and checks every sample.
 *
 *   cyclone_reader DOMAIN WALKER IMU_SAMPLES POSE_SAMPLES [TIMEOUT_S [PERIOD_NS]]
 *
 * Says "ready" once a sample of each has come: a reader of Cyclone's misses what is sent while it
 * matches, or before the writer's first heartbeat. With PERIOD_NS the stamps of each topic must be
 * that far apart, so that a sample lost after the first is seen.
 *
 * Exit code 0: that many good samples of each came. 1: not within the time (60 s). 2: a bad sample.
 * 3: wrong arguments or no DDS. The network interface is chosen by CYCLONEDDS_URI. */
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dds/dds.h"
#include "geometry_msgs.h"
#include "sensor_msgs.h"

enum { EXIT_TIMEOUT = 1, EXIT_BAD_SAMPLE = 2, EXIT_SETUP = 3 };
enum { MAX_NAME = 256, SAMPLES_PER_TAKE = 64 };

typedef bool (*check_fn)(const void* sample, int64_t* stamp_ns);

struct stream {
  char topic[MAX_NAME];
  dds_entity_t reader;
  check_fn good;
  int64_t last_ns;
  int64_t period_ns; /* 0: any, but forward */
  long wanted;
  long received;
};

static bool finite3(double x, double y, double z) {
  return isfinite(x) && isfinite(y) && isfinite(z);
}

static int64_t nanoseconds(const std_msgs_msg_Header* header) {
  return header->stamp.sec * INT64_C(1000000000) + header->stamp.nanosec;
}

static bool good_imu(const void* sample, int64_t* stamp_ns) {
  const sensor_msgs_msg_Imu* imu = sample;
  *stamp_ns = nanoseconds(&imu->header);
  return strcmp(imu->header.frame_id, "imu_link") == 0 && imu->orientation_covariance[0] == -1.0 &&
         finite3(imu->linear_acceleration.x, imu->linear_acceleration.y,
                 imu->linear_acceleration.z) &&
         finite3(imu->angular_velocity.x, imu->angular_velocity.y, imu->angular_velocity.z);
}

static bool good_pose(const void* sample, int64_t* stamp_ns) {
  const geometry_msgs_msg_PoseWithCovarianceStamped* pose = sample;
  const geometry_msgs_msg_Quaternion* q = &pose->pose.pose.orientation;
  const geometry_msgs_msg_Point* p = &pose->pose.pose.position;
  const double norm = sqrt(q->x * q->x + q->y * q->y + q->z * q->z + q->w * q->w);
  *stamp_ns = nanoseconds(&pose->header);
  return strcmp(pose->header.frame_id, "map") == 0 && finite3(p->x, p->y, p->z) &&
         fabs(norm - 1.0) < 1e-6;
}

/* The name that a ROS 2 type has on the wire is not that of its IDL: pkg::msg::dds_::Type_. */
static dds_entity_t open_reader(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* wire_name, const char* topic_name) {
  dds_topic_descriptor_t named = *type;
  named.m_typename = wire_name;
  const dds_entity_t topic = dds_create_topic(participant, &named, topic_name, NULL, NULL);
  if (topic < 0) return topic;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

static bool in_step(const struct stream* stream, int64_t stamp_ns) {
  if (stream->received == 0) return true;
  if (stream->period_ns == 0) return stamp_ns > stream->last_ns;
  return stamp_ns == stream->last_ns + stream->period_ns;
}

/* False at the first bad sample. */
static bool take_all(struct stream* stream) {
  void* samples[SAMPLES_PER_TAKE] = {NULL};
  dds_sample_info_t infos[SAMPLES_PER_TAKE];
  const int count = dds_take(stream->reader, samples, infos, SAMPLES_PER_TAKE, SAMPLES_PER_TAKE);
  bool good = count >= 0;
  for (int i = 0; i < count && good; ++i) {
    if (!infos[i].valid_data) continue;
    int64_t stamp_ns = 0;
    good = stream->good(samples[i], &stamp_ns) && in_step(stream, stamp_ns);
    if (!good) {
      printf("%s: bad sample after %ld good ones, stamp %" PRId64 " ns\n", stream->topic,
             stream->received, stamp_ns);
      break;
    }
    stream->last_ns = stamp_ns;
    ++stream->received;
  }
  if (count > 0) dds_return_loan(stream->reader, samples, count);
  return good;
}

static int receive(dds_entity_t participant, struct stream* streams, dds_time_t deadline) {
  const dds_entity_t waitset = dds_create_waitset(participant);
  for (int i = 0; i < 2; ++i) {
    const dds_entity_t ready = dds_create_readcondition(streams[i].reader, DDS_ANY_STATE);
    dds_waitset_attach(waitset, ready, i);
  }
  bool ready = false;
  while (streams[0].received < streams[0].wanted || streams[1].received < streams[1].wanted) {
    if (dds_waitset_wait_until(waitset, NULL, 0, deadline) <= 0) return EXIT_TIMEOUT;
    if (!take_all(&streams[0]) || !take_all(&streams[1])) return EXIT_BAD_SAMPLE;
    if (ready || streams[0].received == 0 || streams[1].received == 0) continue;
    ready = true;
    printf("ready\n");
    fflush(stdout);
  }
  return EXIT_SUCCESS;
}

static void set_up(struct stream* stream, const char* walker, const char* name, check_fn good,
                   const char* wanted, const char* period_ns) {
  snprintf(stream->topic, sizeof(stream->topic), "rt/%s/%s", walker, name);
  stream->good = good;
  stream->period_ns = atoll(period_ns);
  stream->wanted = atol(wanted);
}

int main(int argc, char** argv) {
  if (argc < 5 || argc > 7) {
    fprintf(stderr, "usage: %s DOMAIN WALKER IMU_SAMPLES POSE_SAMPLES [TIMEOUT_S [PERIOD_NS]]\n",
            argv[0]);
    return EXIT_SETUP;
  }
  const char* period_ns = argc > 6 ? argv[6] : "0";
  struct stream streams[2] = {{.received = 0}, {.received = 0}};
  set_up(&streams[0], argv[2], "imu/data_raw", good_imu, argv[3], period_ns);
  set_up(&streams[1], argv[2], "fusion/pose", good_pose, argv[4], period_ns);
  const dds_time_t deadline = dds_time() + DDS_SECS(argc > 5 ? atol(argv[5]) : 60);

  const dds_entity_t participant =
      dds_create_participant((dds_domainid_t)atol(argv[1]), NULL, NULL);
  if (participant < 0) {
    fprintf(stderr, "no participant: %s\n", dds_strretcode(participant));
    return EXIT_SETUP;
  }
  streams[0].reader = open_reader(participant, &sensor_msgs_msg_Imu_desc,
                                  "sensor_msgs::msg::dds_::Imu_", streams[0].topic);
  streams[1].reader =
      open_reader(participant, &geometry_msgs_msg_PoseWithCovarianceStamped_desc,
                  "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_", streams[1].topic);
  int code = EXIT_SETUP;
  if (streams[0].reader >= 0 && streams[1].reader >= 0) {
    code = receive(participant, streams, deadline);
  }
  for (int i = 0; i < 2; ++i) {
    printf("%s: %ld of %ld samples\n", streams[i].topic, streams[i].received, streams[i].wanted);
  }
  dds_delete(participant);
  return code;
}
