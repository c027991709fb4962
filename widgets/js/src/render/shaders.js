/** The programs of surfaces, lines, points and outlines; `materials.js` says what they are for. */

export const MARK = /* glsl */ `
  float mark = step( 1.5, vTint.a );
  diffuseColor = vec4( vTint.rgb, vTint.a - 2.0 * mark );
  #ifdef WIRE
    diffuseColor.rgb = mix( diffuseColor.rgb, rim, 0.5 );
  #endif
`;

export const MARKER = /* glsl */ `
  uniform vec3 accent;
  uniform vec3 accent2;
  vec3 marker( vec3 own ) {
    return distance( sqrt( own ), sqrt( accent ) ) < 0.6 ? accent2 : accent;
  }
`;

export const RIM = /* glsl */ `
  float grazing = 1.0 - saturate( abs( dot( normal, geometryViewDir ) ) );
  float grazing2 = grazing * grazing;
  outgoingLight = mix( outgoingLight, rim, rimStrength * grazing * grazing2 );
  float clear = 1.0 - diffuseColor.a;
  float glow = mark * ( 0.1 + ( 0.3 + 0.6 * clear ) * grazing2 );
  outgoingLight = mix( outgoingLight, vMarker, glow );
  diffuseColor.a += clear * glow;
`;

// What marks a surface is alike all over a triangle: it is worked out for vertices, of which there are fewer.
export const MARKED = /* glsl */ `
  vTint = tint;
  #ifdef USE_COLOR_ALPHA
    vMarker = marker( tint.rgb * color.rgb );
  #else
    vMarker = marker( tint.rgb );
  #endif
`;

// The cofactors of the matrix carry normals rightly whatever it does, shear and stretch included.
export const NORMAL = /* glsl */ `
  vec3 transformedNormal = objectNormal;
  #ifdef USE_INSTANCING
    mat3 im = mat3( instanceMatrix );
    transformedNormal = cross( im[ 1 ], im[ 2 ] ) * objectNormal.x + cross( im[ 2 ], im[ 0 ] ) * objectNormal.y
      + cross( im[ 0 ], im[ 1 ] ) * objectNormal.z;
  #endif
  transformedNormal = normalMatrix * transformedNormal;
  #ifdef FLIP_SIDED
    transformedNormal = - transformedNormal;
  #endif
`;

// A surface is lit on the side that one sees. At its outline slivers are seen from behind whose normals are those of
// the front: turned round they would be dark dots.
export const SIDE = /* glsl */ `
  #ifdef FLAT_SHADED
    vec3 normal = normalize( cross( dFdx( vViewPosition ), dFdy( vViewPosition ) ) );
  #else
    vec3 normal = normalize( vNormal );
    #ifdef DOUBLE_SIDED
      if ( ! gl_FrontFacing && dot( normal, normalize( vViewPosition ) ) < - 0.1 ) normal = - normal;
    #endif
  #endif
`;

export const STROKE_VERTEX = /* glsl */ `
  attribute vec3 other;
  attribute float side;
  attribute vec4 tint;
  uniform vec2 resolution;
  uniform float density;
  uniform float width;
  uniform float lift;
  varying vec4 vTint;
  varying vec2 vAcross;

  vec4 seen( vec3 p ) {
    vec4 local = vec4( p, 1.0 );
    #ifdef USE_INSTANCING
      local = instanceMatrix * local;
    #endif
    vec4 view = modelViewMatrix * local;
    view.xyz *= 1.0 - lift;
    return view;
  }

  void main() {
    vec4 own = seen( position );
    vec4 far = seen( other );
    float near = - 1e-3;
    if ( own.z > near && far.z < near ) own = mix( own, far, ( own.z - near ) / ( own.z - far.z ) );
    if ( far.z > near && own.z < near ) far = mix( far, own, ( far.z - near ) / ( far.z - own.z ) );
    vec4 a = projectionMatrix * own;
    vec4 b = projectionMatrix * far;
    vec2 way = ( b.xy / b.w - a.xy / a.w ) * resolution;
    float size = length( way );
    vec2 ahead = size > 1e-4 ? way / size : vec2( 1.0, 0.0 );
    float reach = 0.5 * width * density * ( tint.a > 1.5 ? 2.0 : 1.0 ) + 1.0;
    float hand = sign( side );
    vec2 offset = vec2( - ahead.y, ahead.x ) * hand * reach - ahead * 0.5 * width * density;
    a.xy += 2.0 * offset / resolution * a.w;
    gl_Position = a;
    vTint = tint;
    vAcross = vec2( ( abs( side ) > 1.5 ? - hand : hand ) * reach * a.w, a.w );
  }
`;

export const STROKE_FRAGMENT = /* glsl */ `
  uniform float density;
  uniform float width;
  uniform float ink;
  uniform float crease;
  ${MARKER}
  varying vec4 vTint;
  varying vec2 vAcross;

  void main() {
    float mark = step( 1.5, vTint.a );
    vec4 paint = vec4( vTint.rgb, vTint.a - 2.0 * mark );
    float light = dot( paint.rgb, vec3( 0.2126, 0.7152, 0.0722 ) );
    vec3 dark = light < 0.02 ? paint.rgb + 0.06 : paint.rgb * 0.12;
    paint = mix( paint, vec4( dark, ink * sqrt( paint.a ) ), crease );
    paint = mix( paint, vec4( marker( vTint.rgb ), 1.0 ), mark );
    float inside = 0.5 * width * density * ( 1.0 + mark ) + 0.5 - abs( vAcross.x / vAcross.y );
    paint.a *= clamp( inside, 0.0, 1.0 );
    if ( paint.a < 0.02 ) discard;
    gl_FragColor = paint;
    #include <colorspace_fragment>
  }
`;

export const DOT_VERTEX = /* glsl */ `
  attribute vec4 tint;
  uniform float density;
  uniform float width;
  varying vec4 vTint;

  void main() {
    vec4 view = modelViewMatrix * vec4( position, 1.0 );
    view.xyz *= 0.998;
    gl_Position = projectionMatrix * view;
    gl_PointSize = width * density + 1.0;
    vTint = tint;
  }
`;

export const DOT_FRAGMENT = /* glsl */ `
  uniform float density;
  uniform float width;
  ${MARKER}
  varying vec4 vTint;

  void main() {
    float mark = step( 1.5, vTint.a );
    float size = width * density;
    float away = length( gl_PointCoord - 0.5 ) * ( size + 1.0 );
    vec4 paint = vec4( mix( vTint.rgb, marker( vTint.rgb ), mark ), vTint.a - 2.0 * mark );
    paint.rgb *= 1.0 - 0.45 * smoothstep( 0.5 * size - 1.6 * density, 0.5 * size - 0.6 * density, away );
    paint.a *= clamp( 0.5 * size + 0.5 - away, 0.0, 1.0 );
    if ( paint.a < 0.02 ) discard;
    gl_FragColor = paint;
    #include <colorspace_fragment>
  }
`;

export const OUTLINE_VERTEX = /* glsl */ `
  attribute vec4 tint;
  uniform vec2 resolution;
  uniform float density;
  varying vec4 vTint;

  void main() {
    vec3 objectNormal = normal;
    ${NORMAL}
    vec4 local = vec4( position, 1.0 );
    #ifdef USE_INSTANCING
      local = instanceMatrix * local;
    #endif
    gl_Position = projectionMatrix * modelViewMatrix * local;
    vec2 away = ( projectionMatrix * vec4( - transformedNormal, 0.0 ) ).xy * resolution; // back sides are flipped
    gl_Position.xy += normalize( away + 1e-6 ) * 5.0 * density / resolution * gl_Position.w;
    if ( tint.a < 1.5 ) gl_Position = vec4( 2.0, 2.0, 2.0, 1.0 );
    vTint = tint;
  }
`;

export const OUTLINE_FRAGMENT = /* glsl */ `
  ${MARKER}
  varying vec4 vTint;

  void main() {
    gl_FragColor = vec4( marker( vTint.rgb ), 1.0 );
    #include <colorspace_fragment>
  }
`;
