#pragma once

// The baseline of bench_direct: what one writes without skein, a loop over sources in a loop over targets, compiled
// with -O3 -march=native -ffast-math. Arrays are x, y, z one after the other, [3 n].
void plain_loop(int n, const double* position, const double* force, double blob, double viscosity, double* velocity);
void plain_loop(int n, const float* position, const float* force, float blob, float viscosity, float* velocity);
