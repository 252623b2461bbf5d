// SPDX-License-Identifier: Apache-2.0
#ifndef MXG_SLABS_DIFFERENCE_H
#define MXG_SLABS_DIFFERENCE_H

/*
 * CIEDE2000 (CIE 142-2001; formulas as in Sharma, Wu and Dalal 2005, "The CIEDE2000
 * Color-Difference Formula") of two colours, linear Rec. 709 with white (1, 1, 1). Components are
 * clamped to 0..1, as a display does.
 */
double color_difference(const float a[3], const float b[3]);

/* The difference of two colours in CIELAB. */
double lab_difference(const double a[3], const double b[3]);

#endif
