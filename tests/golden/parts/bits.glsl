// bitCount is not in the portable language
void bits(float x, out float result)
{
    result = float(bitCount(floatBitsToInt(x)));
}
