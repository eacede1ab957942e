#pragma once
/// How a function of the FMI standard leaves the shared library.
#if defined(_WIN32)
#define SPOOLFLOW_FMI extern "C" __declspec(dllexport)
#else
#define SPOOLFLOW_FMI extern "C" __attribute__((visibility("default")))
#endif
