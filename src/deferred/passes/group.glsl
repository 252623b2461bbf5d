shared uint mx_bits;

// The bits that the invocations of a group have. Each of them calls it, once.
uint mx_or_in_group(uint bits, uint index)
{
    if (index == 0u)
        mx_bits = 0u;
    barrier();
    atomicOr(mx_bits, bits);
    barrier();
    return mx_bits;
}
