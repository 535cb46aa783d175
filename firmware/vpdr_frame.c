#include "vpdr_frame.h"

#include <string.h>

#define VPDR_VERSION 1u
#define VPDR_RAW_MAX_BYTES 54

static uint8_t* put_u16(uint8_t* p, uint16_t value) {
  *p++ = (uint8_t)(value & 0xFFu);
  *p++ = (uint8_t)(value >> 8);
  return p;
}

static uint8_t* put_u32(uint8_t* p, uint32_t value) {
  p = put_u16(p, (uint16_t)(value & 0xFFFFu));
  return put_u16(p, (uint16_t)(value >> 16));
}

static uint8_t* put_floats(uint8_t* p, const float* values, int count) {
  for (int i = 0; i < count; ++i) {
    uint32_t bits;
    memcpy(&bits, &values[i], sizeof bits);
    p = put_u32(p, bits);
  }
  return p;
}

/* Consistent overhead byte stuffing of fewer than 254 bytes, and the closing zero. */
static size_t put_cobs(const uint8_t* raw, size_t count, uint8_t* out) {
  uint8_t* code = out;
  uint8_t* p = out + 1;
  for (size_t i = 0; i < count; ++i) {
    if (raw[i] == 0) {
      *code = (uint8_t)(p - code);
      code = p++;
    } else {
      *p++ = raw[i];
    }
  }
  *code = (uint8_t)(p - code);
  *p++ = 0;
  return (size_t)(p - out);
}

uint16_t vpdr_crc16(const uint8_t* bytes, size_t count) {
  uint16_t crc = 0xFFFFu;
  for (size_t i = 0; i < count; ++i) {
    crc = (uint16_t)(crc ^ ((uint16_t)bytes[i] << 8));
    for (int bit = 0; bit < 8; ++bit) {
      const unsigned shifted = (unsigned)crc << 1;
      crc = (uint16_t)((crc & 0x8000u) ? shifted ^ 0x1021u : shifted);
    }
  }
  return crc;
}

size_t vpdr_frame_encode(const vpdr_frame* frame, uint8_t* out) {
  uint8_t raw[VPDR_RAW_MAX_BYTES];
  uint8_t* p = raw;
  const unsigned contents = frame->contents & 0x1Fu;
  *p++ = VPDR_VERSION;
  *p++ = (uint8_t)contents;
  p = put_u16(p, frame->sequence);
  p = put_u32(p, frame->time_us);
  if (contents & VPDR_ACCELERATION) p = put_floats(p, frame->acceleration_mps2, 3);
  if (contents & VPDR_ANGULAR_RATE) p = put_floats(p, frame->angular_rate_radps, 3);
  if (contents & VPDR_MAGNETIC_FIELD) p = put_floats(p, frame->magnetic_field_ut, 3);
  if (contents & VPDR_PRESSURE) p = put_floats(p, &frame->pressure_pa, 1);
  if (contents & VPDR_TEMPERATURE) p = put_floats(p, &frame->temperature_c, 1);
  p = put_u16(p, vpdr_crc16(raw, (size_t)(p - raw)));
  return put_cobs(raw, (size_t)(p - raw), out);
}
