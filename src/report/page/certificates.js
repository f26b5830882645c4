// Certificates of motion (docs/certificate.md), checked in this page by verify/, which was compiled to WebAssembly.

// The bytes of an element that holds base64 of gzip.
async function unpacked(id) {
  const text = atob($(id).textContent.replace(/\s/g, '')), bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// @param motion  bytes of its motion file, none if it is not there
// @return {broken: why} or {accepted, rules: [{name, unit, tolerance, claimed, found, difference, step, good}]}
async function verdict_of(certificate, motion) {
  const {instance} = await WebAssembly.instantiate(await unpacked('verifier'));
  const {memory, room, verify, rule, reason} = instance.exports;
  const place = (bytes) => {
    const at = room(bytes.length) >>> 0;
    if (!at) throw new Error('there is not enough memory');
    new Uint8Array(memory.buffer).set(bytes, at);
    return at;
  };
  const status = verify(place(certificate), certificate.length, place(motion), motion.length);
  const text = (at) => {
    const bytes = new Uint8Array(memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  };
  if (status === 2) return {broken: text(reason())};
  const rules = [], view = new DataView(memory.buffer);  // name, unit, four doubles, step: verify.h
  for (let i = 0, at = rule(0); at; at = rule(++i)) {
    const [tolerance, claimed, found, difference] = [8, 16, 24, 32].map((more) => view.getFloat64(at + more, true));
    rules.push({name: text(view.getUint32(at, true)), unit: text(view.getUint32(at + 4, true)), tolerance, claimed, found,
                difference, step: view.getInt32(at + 40, true), good: difference <= tolerance});
  }
  return {accepted: status === 0, rules};
}

function rules_table(rules) {
  const heads = ['rule', 'unit', 'claimed', 'found', 'largest difference', 'tolerance', 'step', ''];
  const number = (x) => with_minus(String(Number(x.toPrecision(4))));
  return make('div', {className: 'scroll'}, make('table', {},
      make('thead', {}, make('tr', {}, ...heads.map((head) => make('th', {scope: 'col'}, head)))),
      make('tbody', {}, ...rules.map((r) => make('tr', {className: r.good ? '' : 'failed'},
          make('th', {scope: 'row'}, r.name), make('td', {}, r.unit),
          ...[r.claimed, r.found, r.difference, r.tolerance].map((x) => make('td', {}, number(x))),
          make('td', {}, String(r.step)), make('td', {}, r.good ? '✓' : '✗'))))));
}

function verdict_element(name, verdict, with_motion) {
  const line = (good, text) => make('span', {className: good ? 'ok' : 'failed'}, `${name}: ${text}`);
  if (verdict.broken) return make('li', {}, line(false, verdict.broken));
  const applied = verdict.rules.filter((rule) => rule.step >= 0), failed = applied.filter((rule) => !rule.good);
  const why = verdict.accepted ? `accepted, ${applied.length} rules` : `rejected: ${failed.map((rule) => rule.name).join(', ')}`;
  const alone = with_motion ? '' : ' (without its motion file)';
  return make('li', {}, make('details', {open: !verdict.accepted}, make('summary', {}, line(verdict.accepted, why + alone)),
                             rules_table(applied)));
}

// Verifies the certificates among some files, each with the motion file beside it. @return the other files
function take_certificates(files) {
  const certificates = files.filter((file) => file.name.endsWith('.cert'));
  const motion_of = (certificate) => files.find((file) => file.name === certificate.name.replace(/cert$/, 'npz'));
  const bytes_of = async (file) => file ? new Uint8Array(await file.arrayBuffer()) : new Uint8Array();
  if (certificates.length) $('verdicts').replaceChildren();
  certificates.reduce(async (before, certificate) => {  // one after the other: each takes memory
    await before;
    const motion = motion_of(certificate);
    const verdict = await Promise.all([bytes_of(certificate), bytes_of(motion)]).then((both) => verdict_of(...both))
        .catch((error) => ({broken: error.message}));
    $('verdicts').append(verdict_element(certificate.name, verdict, motion));
    $('certificates').scrollIntoView({block: 'end'});
  }, null);
  const taken = new Set([...certificates, ...certificates.map(motion_of)]);
  return files.filter((file) => !taken.has(file));
}

// @param take_others  called with dropped files that are no certificates
function listen_to_certificates(take_others) {
  addEventListener('dragover', (e) => e.preventDefault());
  addEventListener('drop', (e) => { e.preventDefault(); take_others(take_certificates([...e.dataTransfer.files])); });
  $('choose-certificates').onclick = () => $('certificate').click();
  $('certificate').onchange = () => { take_certificates([...$('certificate').files]); $('certificate').value = ''; };
}
