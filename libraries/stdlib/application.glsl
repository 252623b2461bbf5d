// SPDX-License-Identifier: Apache-2.0
// What the host tells of the moment.

uniform float u_frame;
uniform float u_time;
