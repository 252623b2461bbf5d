// SPDX-License-Identifier: Apache-2.0
// Roughness tracking: a rough interface spreads the light that goes through it, so what lies below looks rougher (Belcour 2018, "Efficient
// Rendering of Layered Materials using an Atomic Decomposition with Statistical Operators"). A spread is the variance of a lobe; those of
// interfaces one behind the other add up. The compiler calls these functions (src/slabs/spread.c).

// Variance of a lobe of width alpha.
float mx_spread_of_alpha(float alpha)
{
    float wide = min(pow(max(alpha, 0.0), 1.1), 0.999);
    return wide / (1.0 - wide);
}

// Roughness of the lobe that has a variance: the square root of alpha.
float mx_spread_roughness(float spread)
{
    return pow(spread / (spread + 1.0), 0.5 / 1.1);
}

// Roughness of a lobe whose light spreads further.
float mx_spread_widened(float roughness, float spread)
{
    return mx_spread_roughness(mx_spread_of_alpha(roughness * roughness) + spread);
}

// How much of an interface is there for light that goes through, 0 to 1. It fades out where f0 falls below 0.02, and nothing goes through
// opaque matter, whose mean free path is 0.
float mx_spread_presence(vec3 f0, vec3 mean_free_path)
{
    float faded = clamp(max(f0.x, max(f0.y, f0.z)) * 50.0, 0.0, 1.0);
    return max(mean_free_path.x, max(mean_free_path.y, mean_free_path.z)) > 0.0 ? faded : 0.0;
}

// Alpha of the mean roughness of both lobes of an interface.
float mx_spread_alpha(float roughness, float second_roughness, float second_weight)
{
    float mean = mix(roughness, second_roughness, second_weight);
    return mean * mean;
}

// Spread of light that goes in and out through an interface of width alpha and index 1.5.
//
// The widths of the refracted lobes are alpha/2 |n - 1| / n and alpha/2 |1/n - 1| n.
float mx_spread(float alpha, float presence, float coverage)
{
    return (mx_spread_of_alpha(alpha * (1.0 / 6.0)) + mx_spread_of_alpha(alpha * 0.25)) * presence * coverage;
}

// Variance of the slope of a refracted way per axis, for each centimetre of it.
//
// Half of the facets of GGX have a slope below alpha, and refraction to the index 1.5 leaves a third of it; (alpha / 3)^2 / (2 ln 2) is the
// variance of a normal distribution with that median.
float mx_spread_slope(float alpha, float presence, float coverage)
{
    return alpha * alpha * 0.0801 * presence * coverage;
}

// The view behind rough interfaces as a covariance of slope and place along an axis: a way through a thickness shears it. `both` grows by the
// slope that it meets,
float mx_spread_both(float both, float slope, float thickness)
{
    return both + thickness * slope;
}

// and the place by `both` before and behind.
float mx_spread_place(float place, float before, float behind, float thickness)
{
    return place + thickness * (before + behind);
}
