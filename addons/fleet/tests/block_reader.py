"""read_block(bytes): a block of addons/live/blocks/block.hpp as Python values, by Python's zlib and libzstd alone."""
import ctypes
import ctypes.util
import math
import struct
import zlib

STEPS = (("current_A", 2.0**-16), ("voltage_V", 2.0**-12), ("position_m", 2.0**-30), ("oil_temperature_K", 2.0**-10),
         ("current_a_A", 2.0**-16), ("voltage_a_V", 2.0**-12), ("pressure_p_Pa", 8.0), ("pressure_a_Pa", 8.0),
         ("pressure_b_Pa", 8.0), ("pressure_t_Pa", 8.0))
ZSTD = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
ZSTD.ZSTD_decompress.restype = ctypes.c_size_t
ZSTD.ZSTD_decompress.argtypes = (ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t)


def numbers(body):
    value = shift = 0
    for byte in body:
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            yield value
            value = shift = 0


def unfolded(code):
    return -(code + 1) // 2 if code % 2 else code // 2


class Report:
    """The body of a block of version 2, member after member."""

    def __init__(self, body):
        self.body, self.at = body, 0

    def number(self, form="q"):
        value = struct.unpack_from("<" + form, self.body, self.at)[0]
        self.at += struct.calcsize(form)
        return value

    def numbers(self, form, *names):
        return {name: self.number(form) for name in names}

    def text(self):
        length = self.number("I")
        self.at += length
        return self.body[self.at - length:self.at].decode()

    def entries(self, read):
        return [read() for _ in range(self.number("I"))]

    def indicator(self):
        return {"name": self.text(), **self.numbers("d", "value", "uncertainty_95", "baseline"), "state": self.text(),
                "unit": self.text()}

    def event(self):
        return {**self.numbers("q", "wall_ms"), **self.numbers("d", "time_s"), "kind": self.text(), "text": self.text()}

    def alarm(self):
        return {**self.numbers("q", "id"), "cause": self.text(), "sign": self.text(),
                **self.numbers("q", "raised_ms", "gone_ms", "acknowledged_ms"), "acknowledged_by": self.text(),
                **self.numbers("q", "times"), **self.numbers("d", "time_s"), "text": self.text(),
                "indicators": self.entries(self.indicator)}

    def read(self):
        summary = {**self.numbers("Q", "samples"),
                   **self.numbers("d", "time_s", "flow_min", "flow_mean", "flow_max", "lower_min", "upper_max", "energy_J"),
                   **self.numbers("I", "status")}
        out = {"summary": summary, **self.numbers("Q", "samples"), **self.numbers("d", "energy_J"),
               "indicators": self.entries(self.indicator), "events": self.entries(self.event),
               "alarms": self.entries(self.alarm)}
        assert self.at == len(self.body)
        return out


def read_block(block):
    """Of version 1 with a column for each channel, of version 2 with what Report.read() returns."""
    mark, version, length, channels = struct.unpack_from("<4sBBH", block)
    assert mark == b"SFBL" and version in (1, 2)
    assert zlib.crc32(block[:-4]) == struct.unpack("<I", block[-4:])[0]
    session, number, first, wall_ms, time, period, count, size = struct.unpack_from("<QQQqqqII", block, 8)
    out = {"valve": block[104:104 + length].decode(), "session": session, "number": number, "first": first,
           "wall_ms": wall_ms, "model_sha256": block[72:104].hex()}
    frame = block[104 + length:-4]
    body = ctypes.create_string_buffer(max(size, 1))
    if size:
        assert ZSTD.ZSTD_decompress(body, size, frame, len(frame)) == size
    if version == 2:
        assert (channels, time, period, count) == (0, 0, 0, 0)
        return {**out, **(Report(body.raw[:size]).read() if size else {})}
    out["time_s"] = []
    codes = numbers(body.raw[:size])
    for _ in range(count):
        code = next(codes)
        if code >= 2:
            time += unfolded(code - 2)
        out["time_s"].append(time * 2.0**-30 if code >= 2 else math.nan)
        time += period if code >= 2 else 0
    for bit, (name, step) in enumerate(STEPS):
        if not channels >> bit & 1:
            continue
        value, column = 0, []
        for _ in range(count):
            code = next(codes)
            if code >= 2:
                value += unfolded(code - 2)
            column.append((math.nan, math.inf)[code] if code < 2 else value * step)
        out[name] = column
    assert next(codes, None) is None
    return out
