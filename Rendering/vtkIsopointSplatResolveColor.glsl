  if (splatColoring != 0)
  {
    vec4 splatColor = vec4(splatColorSum.rgb / splatWeight, 1.0);
    if (splatColoring == 2)
    {
      splatColor = texture(splatColorMap, splatColor.rg);
    }
    else if (splatOpacities != 0)
    {
      splatColor.a = texelFetch(splatOpacitySums, splatPixel, splatSample).r / splatWeight;
    }
    ambientColor = ambientIntensity * splatColor.rgb;
    diffuseColor = diffuseIntensity * splatColor.rgb;
    opacity = opacityUniform * splatColor.a;
  }
