python3 - "$1" "$2" <<'P'
import re,sys
s=open(sys.argv[1]).read()
open(sys.argv[2]+'-dark.svg','w').write(re.sub(r'@media\(.*?\)\{\n(.*?)\n\}\n',r'\1\n',s,flags=re.S))
P
rsvg-convert -w 600 $1 -o $2-light.png; rsvg-convert -w 600 $2-dark.svg -o $2-dark.png
