# What the built site has beside modules and pages: the film of the front page, and the recorded judgement of the port with a mistake. And how it
# is published. Sourced behind lib.sh.

# site_film SITE NATIVE: film/rain.webm, .mp4 and .jpg, four seconds of gallery/drive with the rain itself, each below 1 MB. They are made again
# only if this function, the scene or a golden hash changed.
site_film() {
  local site=$1 native=$2 made=build/film stamp loop pass options
  need ffmpeg
  stamp=$({ declare -f site_film && cat scenes/gallery/drive.toml tests/golden/hashes.txt; } | sha256sum)
  if [ "$(cat $made/complete 2>/dev/null)" != "$stamp" ]; then
    say "Filming gallery/drive for the front page"
    rm -rf $made
    mkdir -p $made
    # The car stands, so that the megabyte is spent on rain; 40 frames are a stroke of the wipers.
    options=('vehicle.drive_cycle=""' vehicle.speed=0 'rain.key_frames=""' rain.rate=100 'wipers.key_frames="0 slow"' 'world.wind_key_frames=""'
      'world.wind=[0,-2,0]' falling_rain.on=true falling_rain.exposure=0.02 falling_rain.gain=3 falling_rain.far=6)
    "$native" run gallery/drive --size 960x540 --first 150 --frames 285 "${options[@]/#/--set=}" --film $made/drive.mp4 --image none \
      -o $made/run >$made/log 2>&1 || die "The film could not be made (log: $made/log)"
    # The last half second passes into the one before the first picture, so that no one sees where it begins anew.
    loop="split[a][b];[a]trim=start_frame=15,setpts=PTS-STARTPTS[rest];[b]trim=end_frame=15,setpts=PTS-STARTPTS[head];"
    loop+="[rest][head]xfade=duration=0.5:offset=3.5,format=yuv420p"
    {
      for pass in 1 2; do
        ffmpeg -nostdin -y -i $made/drive.mp4 -filter_complex "$loop" -an -c:v libvpx-vp9 -b:v 1750k -deadline good -cpu-used 3 -row-mt 1 -g 240 -arnr-strength 1 -pass $pass \
          -passlogfile $made/vp9 -fflags +bitexact -flags:v +bitexact $made/rain.webm
        ffmpeg -nostdin -y -i $made/drive.mp4 -filter_complex "$loop" -an -c:v libx264 -preset slow -b:v 1750k -maxrate 3M -bufsize 3M -movflags +faststart -pass $pass \
          -passlogfile $made/x264 -fflags +bitexact -flags:v +bitexact $made/rain.mp4
      done
      ffmpeg -nostdin -y -i $made/drive.mp4 -vf "select=eq(n\,15)" -frames:v 1 -q:v 4 $made/rain.jpg
    } >>$made/log 2>&1 || die "The film could not be encoded (log: $made/log)"
    rm -rf $made/{run,drive.mp4}
    for pass in $made/rain.*; do
      [ "$(stat -c %s "$pass")" -le 1000000 ] || die "$pass has more than 1 MB"
    done
    echo "$stamp" >$made/complete
  fi
  mkdir -p "$site/film"
  cp $made/rain.{webm,mp4,jpg} "$site/film/"
}

# site_mistake SITE NATIVE: mistake/, what the judge says of the two ports of `rainref demo`, as it would be in a browser without WebGPU. The
# caller adds mistake.json.
site_mistake() {
  local site=$1 native=$2 made=build/mistake port code
  rm -rf $made
  mkdir -p build "$site/mistake"
  "$native" demo -o $made >$made.log 2>&1 || die "rainref demo failed (log: $made.log)"
  for port in wrong right; do
    code=0
    (cd $made && "$native" validate pack --port $port/out --spirv $port/shaders --json $port.json --html $port.html --junit $port.xml >$port.txt) || code=$?
    [ "$port $code" = "wrong 1" ] || [ "$port $code" = "right 0" ] || die "rainref validate ended with $code for the $port port"
    cp $made/$port.{json,html,xml,txt} "$site/mistake/"
  done
}

# publish_site SITE FOLDER: a copy for a static host, which works without a network after the first visit (src/web/offline).
publish_site() {
  local offline=src/web/offline
  command -v npm >/dev/null || need nodejs npm
  mkdir -p build/offline
  cp $offline/* build/offline/
  npm ci --no-audit --no-fund --ignore-scripts --prefix build/offline >build/offline/npm.log 2>&1 || die "npm ci failed (log: build/offline/npm.log)"
  command node build/offline/publish.mjs "$1" "$2"
}
