// Clusters of motions: their colours and words, and the map of them on the first page.

// Colours of Okabe and Ito; every cluster has its number on the map, too.
const cluster_looks = 6;
const cluster_colour = (c) => `var(--cluster-${c % cluster_looks})`;

const option_in_words = (option) => {
  const words = data.map && data.map.clusters[option];
  return words ? `option ${option}: ${words}` : `option ${option}`;
};

const middle_of = (points) => [0, 1].map((i) => points.reduce((sum, p) => sum + p[i], 0) / points.length);

// Scales from the two coordinates of a motion to positions on the map.
function scales_of(points, plot) {
  const of = (i) => points.map((p) => p[i]), low = [0, 1].map((i) => Math.min(...of(i))), high = [0, 1].map((i) => Math.max(...of(i)));
  const room = [0, 1].map((i) => 0.06 * (high[i] - low[i] || 1));
  const per = [(plot.width - plot.left - plot.right) / (high[0] - low[0] + 2 * room[0]), (plot.height - plot.top - plot.bottom) / (high[1] - low[1] + 2 * room[1])];
  return {x: (v) => plot.left + per[0] * (v - low[0] + room[0]), y: (v) => plot.height - plot.bottom - per[1] * (v - low[1] + room[1])};
}

// Names beside dots where they cover neither another name nor another dot; the others appear under the pointer.
function place_names(dots, picture) {
  const taken = dots.map(({x, y}) => ({x0: x - 6, x1: x + 6, y0: y - 6, y1: y + 6}));
  for (const {x, y, name} of dots) {
    const wide = 6.6 * name.length, sides = [[x + 9, y + 4], [x - 9 - wide, y + 4], [x - wide / 2, y - 10], [x - wide / 2, y + 19]];
    const box_at = ([x0, y0]) => ({x0, x1: x0 + wide, y0: y0 - 9, y1: y0 + 2});
    const free = (b) => taken.every((t) => b.x1 < t.x0 || b.x0 > t.x1 || b.y1 < t.y0 || b.y0 > t.y1);
    const side = sides.find((s) => free(box_at(s)));
    if (!side) continue;
    taken.push(box_at(side));
    picture.append(svg('text', {x: side[0].toFixed(1), y: side[1].toFixed(1), class: 'clip-name'}, name));
  }
}

const first_words = (words) => words.split(', ').slice(0, 2).join(', ');

function map_picture(map) {
  const plot = {width: 760, height: 380, left: 34, right: 14, top: 12, bottom: 32};
  const {x, y} = scales_of([...map.trained, ...map.clips], plot);
  const picture = svg('svg', {viewBox: `0 0 ${plot.width} ${plot.height}`, role: 'img', class: 'wide',
                              'aria-label': `${map.trained.length} training motions in ${map.clusters.length} clusters, and the clips of this run`});
  const arrow = (d, at, words, turn) => picture.append(svg('path', {d, class: 'axis-arrow'}),
      svg('text', {x: at[0], y: at[1], ...(turn ? {transform: `rotate(-90 ${at[0]} ${at[1]})`} : {})}, `${words} →`));
  const low = plot.height - plot.bottom + 8;
  arrow(`M${plot.left} ${low}H${plot.width - plot.right}`, [plot.left + 4, low + 16], first_words(map.axes[0].words), false);
  arrow(`M${plot.left - 8} ${plot.height - plot.bottom}V${plot.top}`, [plot.left - 16, plot.height - plot.bottom - 4], first_words(map.axes[1].words), true);
  const dot = (p, r, style, title) => {
    const made = svg('circle', {cx: x(p[0]).toFixed(1), cy: y(p[1]).toFixed(1), r, ...style});
    made.append(svg('title', {}, title));
    picture.append(made);
    return made;
  };
  for (const p of map.trained)
    dot(p, 3.4, {class: 'trained', style: `fill: ${cluster_colour(p[2])}`}, `${p[3]}: training motion of cluster ${p[2]}`);
  map.clusters.forEach((words, c) => {
    const own = map.trained.filter((p) => p[2] === c);
    if (!own.length) return;
    const [u, v] = middle_of(own), mark = svg('text', {x: x(u), y: y(v) + 7, 'text-anchor': 'middle', class: 'cluster-number', style: `fill: ${cluster_colour(c)}`}, String(c));
    mark.append(svg('title', {}, `cluster ${c}: ${words}`));
    picture.append(mark);
  });
  for (const p of map.clips)
    dot(p, 6, {class: 'clip-dot', style: `fill: ${cluster_colour(p[2])}`}, `${data.rows[p[3]].name}: nearest to cluster ${p[2]}`)
        .addEventListener('click', () => { location.hash = `#${p[3]}`; });
  place_names(map.clips.map((p) => ({x: x(p[0]), y: y(p[1]), name: data.rows[p[3]].name})), picture);
  return picture;
}

function show_map() {
  $('map').hidden = !data.map;
  if (!data.map) return;
  const {map} = data, seen = Math.round(100 * (map.axes[0].share + map.axes[1].share));
  const legend = map.clusters.map((words, c) => {
    const count = map.trained.filter((p) => p[2] === c).length;
    const swatch = make('i');
    swatch.style.background = cluster_colour(c);
    return make('li', {}, swatch, make('b', {}, `${c} `), `${words} (${count} training motion${count === 1 ? '' : 's'})`);
  });
  $('map-card').replaceChildren(map_picture(map), make('ul', {className: 'clusters'}, ...legend),
      make('p', {className: 'hint'}, `A motion is a point: near means alike. The axes are the two directions in which the motions that the options were trained on
        (small dots) differ most; they show ${seen} % of how these differ. To the right: ${map.axes[0].words}. Upwards: ${map.axes[1].words}. The clips of this run are
        ringed, in the colour of the cluster that is nearest to them in all of its features.`));
}
