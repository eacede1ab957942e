/* A valve's electronics send blocks of samples to `spoolflow live` as UDP datagrams (layout: docs/live.md). C99, no heap,
   one buffer; for firmware take spoolflow_datagram() and give what it writes to the network's own send function. The
   main() below sends a made-up course to show it:

       cc -std=c99 send_samples.c -lm -o send_samples && ./send_samples VALVE [HOST [PORT [BLOCKS]]]
*/
#define _DEFAULT_SOURCE /* usleep */
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { SPOOLFLOW_HEADER = 68, SPOOLFLOW_BLOCK = 20, SPOOLFLOW_CHANNELS = 4 };
enum { SPOOLFLOW_LARGEST = SPOOLFLOW_HEADER + 4 * SPOOLFLOW_BLOCK * SPOOLFLOW_CHANNELS + 4 };

typedef struct {
  float current_A, voltage_V, position_m, oil_temperature_K; /* NaN: not measured now */
} spoolflow_sample;

typedef struct {
  const char* valve;  /* up to 32 bytes */
  uint32_t session;   /* another at each start: a random number or the start's count */
  uint64_t sequence;  /* samples sent before in this session */
  int64_t time_ns;    /* of the first sample, by a clock that never runs back */
  uint32_t period_ns; /* from sample to sample */
} spoolflow_block;

static uint32_t spoolflow_crc32(const uint8_t* bytes, size_t count) {
  uint32_t rest = 0xFFFFFFFFu;
  for (size_t k = 0; k < count; ++k) {
    rest ^= bytes[k];
    for (int bit = 0; bit < 8; ++bit) rest = (rest & 1u) ? 0xEDB88320u ^ (rest >> 1) : rest >> 1;
  }
  return rest ^ 0xFFFFFFFFu;
}

static uint8_t* spoolflow_put(uint8_t* at, uint64_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) *at++ = (uint8_t)(value >> (8 * k));
  return at;
}

/* Writes a datagram of up to SPOOLFLOW_BLOCK samples; returns its length. */
size_t spoolflow_datagram(uint8_t out[SPOOLFLOW_LARGEST], const spoolflow_block* block,
                          const spoolflow_sample* samples, uint16_t count) {
  uint8_t* at = out;
  memset(out, 0, SPOOLFLOW_HEADER);
  memcpy(at, "SFLW", 4);
  at += 4;
  at = spoolflow_put(at, 1, 1);      /* version */
  at = spoolflow_put(at, 0, 1);
  at = spoolflow_put(at, 0x000F, 2); /* channels: current, voltage, position, oil temperature */
  at = spoolflow_put(at, block->session, 4);
  at = spoolflow_put(at, count, 2);
  at = spoolflow_put(at, 0, 2);
  at = spoolflow_put(at, block->sequence, 8);
  at = spoolflow_put(at, (uint64_t)block->time_ns, 8);
  at = spoolflow_put(at, block->period_ns, 4);
  for (int k = 0; k < 32 && block->valve[k] != '\0'; ++k) at[k] = (uint8_t)block->valve[k];
  at = out + SPOOLFLOW_HEADER;
  for (uint16_t k = 0; k < count; ++k) {
    const float values[SPOOLFLOW_CHANNELS] = {samples[k].current_A, samples[k].voltage_V, samples[k].position_m,
                                              samples[k].oil_temperature_K};
    for (int channel = 0; channel < SPOOLFLOW_CHANNELS; ++channel) {
      uint32_t bits;
      memcpy(&bits, &values[channel], 4);
      at = spoolflow_put(at, bits, 4);
    }
  }
  at = spoolflow_put(at, spoolflow_crc32(out, (size_t)(at - out)), 4);
  return (size_t)(at - out);
}

#ifndef SPOOLFLOW_NO_MAIN
#include <arpa/inet.h>
#include <math.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

int main(int argc, char** argv) {
  const char* host = argc > 2 ? argv[2] : "127.0.0.1";
  const int port = argc > 3 ? atoi(argv[3]) : 7700;
  const long blocks = argc > 4 ? atol(argv[4]) : 3000;
  const double period_s = 0.001;
  struct sockaddr_in to;
  spoolflow_block block;
  spoolflow_sample samples[SPOOLFLOW_BLOCK];
  uint8_t bytes[SPOOLFLOW_LARGEST];
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  if (argc < 2 || out < 0) {
    fprintf(stderr, "usage: send_samples VALVE [HOST [PORT [BLOCKS]]]\n");
    return 2;
  }
  memset(&to, 0, sizeof to);
  to.sin_family = AF_INET;
  to.sin_port = htons((uint16_t)port);
  if (inet_pton(AF_INET, host, &to.sin_addr) != 1) {
    fprintf(stderr, "%s is no address\n", host);
    return 2;
  }
  block.valve = argv[1];
  block.session = (uint32_t)time(NULL);
  block.sequence = 0;
  block.period_ns = 1000000;
  for (long sent = 0; sent < blocks; ++sent) {
    block.time_ns = (int64_t)block.sequence * block.period_ns;
    for (int k = 0; k < SPOOLFLOW_BLOCK; ++k) {
      const double t = period_s * (double)(block.sequence + (uint64_t)k);
      samples[k].current_A = (float)(1.2 + 0.5 * sin(t));
      samples[k].voltage_V = 4.0f * samples[k].current_A;
      samples[k].position_m = (float)(1e-3 * (1.0 + 0.5 * sin(t)));
      samples[k].oil_temperature_K = 323.15f;
    }
    const size_t length = spoolflow_datagram(bytes, &block, samples, SPOOLFLOW_BLOCK);
    if (sendto(out, bytes, length, 0, (const struct sockaddr*)&to, sizeof to) < 0) perror("sendto");
    block.sequence += SPOOLFLOW_BLOCK;
    usleep((unsigned)(1e6 * period_s * SPOOLFLOW_BLOCK));
  }
  printf("%ld samples sent\n", blocks * SPOOLFLOW_BLOCK);
  return close(out);
}
#endif
