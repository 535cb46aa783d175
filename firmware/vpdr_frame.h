/* Encoder of vpdr's board protocol, version 1, for firmware: C99, no allocation, no dependency.
 * docs/board_protocol.md lays the frame out byte by byte.
 *
 *   static uint16_t sequence;
 *   vpdr_frame frame = {0};
 *   uint8_t bytes[VPDR_FRAME_MAX_BYTES];
 *   frame.contents = VPDR_ACCELERATION | VPDR_ANGULAR_RATE;
 *   frame.sequence = sequence++;
 *   frame.time_us = micros();           // at the instant of measurement, not of sending
 *   ... frame.acceleration_mps2[0] = ...
 *   uart_write(bytes, vpdr_frame_encode(&frame, bytes));
 */
#ifndef VPDR_FRAME_H
#define VPDR_FRAME_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a frame holds; or-ed together. */
#define VPDR_ACCELERATION 1u
#define VPDR_ANGULAR_RATE 2u
#define VPDR_MAGNETIC_FIELD 4u
#define VPDR_PRESSURE 8u
#define VPDR_TEMPERATURE 16u

/* Longest encoded frame, its closing zero byte included. */
#define VPDR_FRAME_MAX_BYTES 56

typedef struct {
  uint8_t contents;           /* VPDR_ACCELERATION | ...; what is not named is not sent */
  uint16_t sequence;          /* one more in each frame, from 65535 to 0 */
  uint32_t time_us;           /* board clock when it was measured, from 4294967295 to 0 */
  float acceleration_mps2[3]; /* specific force: at rest +9.8 on the axis that points up */
  float angular_rate_radps[3];
  float magnetic_field_ut[3];
  float pressure_pa;
  float temperature_c;
} vpdr_frame;

/* Writes the frame with its closing zero byte to `out`, which has room for VPDR_FRAME_MAX_BYTES.
 * Returns the number of bytes written. Send one zero byte after start-up, so that what the line
 * held before is not taken for the beginning of the first frame. */
size_t vpdr_frame_encode(const vpdr_frame* frame, uint8_t* out);

/* CRC-16/CCITT-FALSE; of the nine characters "123456789" it is 0x29B1. */
uint16_t vpdr_crc16(const uint8_t* bytes, size_t count);

#ifdef __cplusplus
}
#endif

#endif
